// Export of figures, schematics and rows as files.
import { file } from './api.js';
import { element } from './dom.js';
import { t } from './messages.js';

export function download(blob, name) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// An SVG as pixels, with two pixels per px.
export function raster(svg) {
  return new Promise((resolve, reject) => {
    const image = new Image();
    image.onload = () => {
      const canvas = element('canvas', { width: image.width * 2, height: image.height * 2 });
      canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error(t('the picture is too large')))), 'image/png');
    };
    image.onerror = () => reject(new Error(t('the picture cannot be drawn')));
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  });
}

// scenes: [{ text, file }], of which the active one is edited; drawn: the same of all runs in the plots, with the `curves` of each;
// schematic: that of the active one.
export function exporters({ scenes, active, drawn, schematic, name }) {
  const figure = () => file({ task: 'figure', scenes: drawn });
  const drawing = () => new Blob([schematic], { type: 'image/svg+xml' });
  return [
    { label: t('Rows (CSV)'), make: () => file({ task: 'csv', ...scenes[active] }), name: `${name}.csv` },
    { label: t('Plots (SVG)'), make: figure, name: `${name}-plots.svg` },
    { label: t('Plots (PNG)'), make: async () => raster(await (await figure()).text()), name: `${name}-plots.png` },
    { label: t('Schematic (SVG)'), make: async () => drawing(), name: `${name}.svg` },
    { label: t('Schematic (PNG)'), make: () => raster(schematic), name: `${name}.png` },
    { label: t('Report (HTML)'), make: () => file({ task: 'report', scenes }), name: `${name}-report.html` },
  ];
}
