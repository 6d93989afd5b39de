// The address of the page as a QR code, for a phone to read.
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

export function showCode(address) {
  const dialog = element('dialog', { class: 'help', 'aria-labelledby': 'qr-title' },
    element('div', { class: 'dialog-head' }, element('h2', { id: 'qr-title' }, t('The link as a QR code')), element('button', { type: 'button', onclick: () => dialog.close(), 'aria-label': t('Close') }, '✕')),
    address.length > most
      ? element('p', { class: 'note bad' }, t('The link has {count} characters, and a QR code holds {most}. Send the link itself.', { count: address.length, most }))
      : picture(address),
    element('p', { class: 'note' }, t('The link has {count} characters, and carries the scene.', { count: address.length })),
    isReachable(address) ? null : element('p', { class: 'note bad' }, unreachable()));
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
