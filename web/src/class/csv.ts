/** Tables as CSV (RFC 4180) that a spreadsheet opens without running anything in them. */

const BYTE_ORDER_MARK = '\uFEFF';

/**
 * What a spreadsheet would take for a formula, at the beginning or behind what some take for the end of a field, gets
 * an apostrophe, so that it stays a text.
 */
export function csvField(value: string | number): string {
  if (typeof value === 'number') return String(value);
  const safe = value.replace(/(^|[;\t\n])(\s*)(?=[=+\-@])/g, "$1'$2");
  return /[",\r\n]/.test(safe) ? `"${safe.replace(/"/g, '""')}"` : safe;
}

/** Begins with the mark by which spreadsheets know UTF-8. */
export function csvTable(rows: readonly (readonly (string | number)[])[]): string {
  return BYTE_ORDER_MARK + rows.map((row) => `${row.map(csvField).join(',')}\r\n`).join('');
}
