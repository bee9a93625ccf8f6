import qrcode from 'qrcode-generator';

const SVG = 'http://www.w3.org/2000/svg';
const QUIET = 4; // modules of margin that readers want

/** A QR code as a picture of one path, dark on light in any theme, since readers want it so. */
export function qrPicture(text: string, label: string): SVGSVGElement {
  const code = qrcode(0, 'M'); // as small as the text allows; a fifth of it may be hidden
  code.addData(text);
  code.make();
  const count = code.getModuleCount();
  let path = '';
  for (let y = 0; y < count; ++y) {
    for (let x = 0; x < count; ++x) if (code.isDark(y, x)) path += `M${x} ${y}h1v1h-1z`;
  }
  const svg = svgElement('svg', {
    role: 'img',
    viewBox: `${-QUIET} ${-QUIET} ${count + 2 * QUIET} ${count + 2 * QUIET}`,
  });
  svg.setAttribute('aria-label', label);
  const size = String(count + 2 * QUIET);
  const paper = svgElement('rect', {
    x: String(-QUIET),
    y: String(-QUIET),
    width: size,
    height: size,
    fill: '#ffffff',
  });
  svg.append(paper, svgElement('path', { d: path, fill: '#000000', 'shape-rendering': 'crispEdges' }));
  return svg;
}

function svgElement<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Record<string, string>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
}
