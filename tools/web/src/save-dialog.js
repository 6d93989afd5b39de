// Saves a netlist in the folder, and asks before it replaces another one.
import { save } from './api.js';
import { element } from './dom.js';
import { t } from './messages.js';

export class SaveDialog {
  // onsaved({ file, version, text }): it is there.
  constructor({ onsaved }) {
    this.onsaved = onsaved;
    this.name = element('input', { type: 'text', 'aria-label': t('Name of the netlist in the folder'), spellcheck: 'false', autocomplete: 'off' });
    this.why = element('output', { class: 'why', hidden: true });
    this.over = element('button', { type: 'button', class: 'overwrite', hidden: true, onclick: () => this.put(this.there) }, t('Overwrite it'));
    const form = element('form', {}, this.name, this.why,
      element('div', { class: 'dialog-foot' }, element('button', { type: 'button', onclick: () => this.dialog.close() }, t('Cancel')),
        this.over, (this.done = element('button', { type: 'submit' }, t('Save')))));
    this.dialog = element('dialog', { class: 'save', 'aria-labelledby': 'save-title' },
      element('div', { class: 'dialog-head' }, element('h2', { id: 'save-title' }, t('Save in the folder'))), form);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      this.put(this.file === this.netlist.file ? this.netlist.version : '');
    });
    this.name.addEventListener('input', () => this.tell(''));
    this.dialog.addEventListener('close', () => this.dialog.remove());
  }

  // Under the name by which it was opened or saved; one that has none yet is asked for it.
  save(netlist) {
    if (netlist.version) this.write(netlist);
    else this.saveAs(netlist);
  }

  // Under its name.
  write(netlist) {
    this.begin(netlist);
    this.put(netlist.version);
  }

  saveAs(netlist) {
    this.begin(netlist);
    this.show();
  }

  begin(netlist) {
    this.netlist = netlist;
    this.name.value = netlist.file;
    this.tell('');
  }

  // The typed name; .toml is added to a name without an ending.
  get file() {
    const name = this.name.value.trim();
    return name && !/\.[^/]*$/.test(name) && !name.endsWith('/') ? `${name}.toml` : name;
  }

  async put(version) {
    const { file } = this;
    const { text } = this.netlist;
    this.over.disabled = this.done.disabled = true; // once is enough
    try {
      const written = await save(file, text, version);
      this.dialog.close();
      this.onsaved({ file, version: written, text });
    } catch (error) {
      this.tell(error.message, error.there);
      this.show();
    } finally {
      this.over.disabled = this.done.disabled = false;
    }
  }

  // Shows why the netlist is not saved; `there` is the version of the file that would be replaced.
  tell(why, there = '') {
    this.there = there;
    this.over.hidden = !there;
    this.why.hidden = !why;
    this.why.textContent = why && `${t('Not saved: {why}.', { why })}${there ? ` ${t('Overwrite it, or give another name.')}` : ''}`;
    this.name.toggleAttribute('aria-invalid', Boolean(why));
  }

  show() {
    if (!this.dialog.open) {
      document.body.append(this.dialog);
      this.dialog.showModal();
    }
    this.name.focus();
    this.name.select();
  }
}
