/**
 * Tells whether a value is another than the last time. The class is said anew ten times a second while somebody leads;
 * what is on the page must not be made anew under a pointer or an open list.
 */
export class News {
  private last = '';

  of(...values: unknown[]): boolean {
    const now = JSON.stringify(values);
    const isNew = now !== this.last;
    this.last = now;
    return isNew;
  }
}
