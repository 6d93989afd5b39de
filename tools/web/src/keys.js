// The keys of the whole page, except within a field, a dialog or the editor. `acts`: the action of each key, by its name.
export function listenToKeys({ save, acts }) {
  document.addEventListener('keydown', (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === 's') {
      event.preventDefault();
      save();
      return;
    }
    const inField = event.target.closest?.('input:not([type=range], [type=radio], [type=checkbox]), textarea, select, .cm-editor, dialog') || (event.key === ' ' && event.target.closest?.('button, summary, input'));
    if (event.target.closest?.('.cm-editor') && event.key === 'Escape' && !event.defaultPrevented) event.target.blur();
    if (inField || event.ctrlKey || event.metaKey || event.altKey || !Object.hasOwn(acts, event.key.toLowerCase())) return;
    event.preventDefault();
    acts[event.key.toLowerCase()]();
  });
}
