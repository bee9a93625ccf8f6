/** How much of the sky each vertex sees past the others, a byte each; of a server that knows none: null. */
export async function fetchShade(): Promise<Uint8Array | null> {
  const answer = await fetch('/shade.bin');
  return answer.ok ? new Uint8Array(await answer.arrayBuffer()) : null;
}
