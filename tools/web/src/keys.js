// The keys of the whole page; those of a field, of a dialog or of the editor are left to them.
export function listenToKeys({ save, play, gallery }) {
  const acts = { ' ': play, g: gallery };
  document.addEventListener('keydown', (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === 's') {
      event.preventDefault();
      save();
      return;
    }
    const inField = event.target.closest?.('input, textarea, select, button, summary, .cm-editor, dialog');
    if (event.target.closest?.('.cm-editor') && event.key === 'Escape') event.target.blur();
    if (inField || event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(acts, event.key)) return;
    event.preventDefault();
    acts[event.key]();
  });
}
