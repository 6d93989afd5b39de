// The address of the page as a QR code, for a phone to read, and as code that shows it within another page.
import { encode } from 'uqr';
import { element } from './dom.js';
import { t } from './messages.js';

const most = 2953; // bytes that a QR code holds
const quiet = 4; // modules around it that stay white

function picture(address) {
  const { data, size } = encode(address, { ecc: 'L', border: 0 });
  const squares = data.flatMap((row, y) => row.map((dark, x) => (dark ? `M${x + quiet} ${y + quiet}h1v1h-1z` : ''))).join('');
  const host = element('div', { class: 'qr' });
  const side = size + 2 * quiet;
  host.innerHTML = `<svg viewBox="0 0 ${side} ${side}" role="img" shape-rendering="crispEdges"><path d="M0 0h${side}v${side}h-${side}z" fill="#fff"/><path d="${squares}" fill="#000"/></svg>`;
  host.firstChild.setAttribute('aria-label', t('QR code of the link'));
  return host;
}

// Whether others can open the address: one of this machine leads nowhere elsewhere.
export function isReachable(address) {
  return !/^(file:|https?:\/\/(localhost|127\.|\[::1\]))/.test(address);
}
export const unreachable = () => t('Only this machine can open this address. A phone needs the page of a web site, or of `rheonet serve --host 0.0.0.0`.');

function show(title, ...content) {
  const dialog = element('dialog', { class: 'help', 'aria-labelledby': 'qr-title' },
    element('div', { class: 'dialog-head' }, element('h2', { id: 'qr-title' }, title), element('button', { type: 'button', onclick: () => dialog.close(), 'aria-label': t('Close') }, '✕')),
    ...content);
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

// Schematic, plots and sliders in a frame, for a course page or a slide.
export function showFrame(address) {
  const [page, scene] = address.split(/#(.*)/s);
  const text = `<iframe src="${page.replace(/\?.*/, '')}?embed#${scene}" width="100%" height="640" style="border: 0"></iframe>`;
  const code = element('textarea', { class: 'frame-code', rows: '6', readonly: true, 'aria-label': t('Code for another page'), onfocus: () => code.select() }, text);
  show(t('Code for another page'), element('p', { class: 'note' }, t('Copied into a page, it shows the schematic, the plots and the sliders there. A page of `rheonet serve` can be shown so only with `--framed-by`.')),
    code, isReachable(address) ? null : element('p', { class: 'note bad' }, unreachable()));
}

export function showCode(address) {
  show(t('The link as a QR code'),
    address.length > most
      ? element('p', { class: 'note bad' }, t('The link has {count} characters, and a QR code holds {most}. Send the link itself.', { count: address.length, most }))
      : picture(address),
    element('p', { class: 'note' }, t('The link has {count} characters, and carries the scene.', { count: address.length })),
    isReachable(address) ? null : element('p', { class: 'note bad' }, unreachable()));
}
