// Saves a netlist or its lesson in the folder, and asks before it replaces another file.
import { save } from './api.js';
import { element } from './dom.js';
import { t } from './messages.js';

export class SaveDialog {
  constructor() {
    this.name = element('input', { type: 'text', spellcheck: 'false', autocomplete: 'off' });
    this.why = element('output', { class: 'why', hidden: true });
    this.over = element('button', { type: 'button', class: 'overwrite', hidden: true, onclick: () => this.put(this.there) }, t('Overwrite it'));
    const form = element('form', {}, this.name, this.why,
      element('div', { class: 'dialog-foot' }, element('button', { type: 'button', onclick: () => this.dialog.close() }, t('Cancel')),
        this.over, (this.done = element('button', { type: 'submit' }, t('Save')))));
    this.dialog = element('dialog', { class: 'save', 'aria-labelledby': 'save-title' },
      element('div', { class: 'dialog-head' }, (this.title = element('h2', { id: 'save-title' }))), form);
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      if (!this.isLesson) this.put(this.file === this.saved.file ? this.saved.version : '');
    });
    this.name.addEventListener('input', () => this.tell(''));
    this.dialog.addEventListener('close', () => this.dialog.remove());
  }

  // A netlist { file, version, text }, under the name by which it was opened or saved; asks for the name of a new one.
  // onsaved({ file, version, text }): the file is written.
  save(netlist, onsaved) {
    if (!netlist.version) return this.saveAs(netlist, onsaved);
    this.begin(netlist, onsaved);
    this.put(netlist.version);
  }

  saveAs(netlist, onsaved) {
    this.begin(netlist, onsaved);
    this.show();
  }

  // A lesson { file, version, text }: its name follows from its netlist, so that only the question whether to overwrite is asked.
  saveLesson(lesson, onsaved) {
    this.begin(lesson, onsaved, true);
    this.put(lesson.version);
  }

  begin(saved, onsaved, isLesson = false) {
    Object.assign(this, { saved, onsaved, isLesson });
    this.title.textContent = isLesson ? t('Save the lesson in the folder') : t('Save in the folder');
    this.name.setAttribute('aria-label', isLesson ? t('Name of the lesson in the folder') : t('Name of the netlist in the folder'));
    this.name.readOnly = this.done.hidden = isLesson;
    this.name.value = saved.file;
    this.tell('');
  }

  // The typed name; .toml is added to the name of a netlist without an ending.
  get file() {
    const name = this.name.value.trim();
    return name && !/\.[^/]*$/.test(name) && !name.endsWith('/') ? `${name}.toml` : name;
  }

  async put(version) {
    const { file, onsaved } = this;
    const { text } = this.saved;
    if (!this.isLesson && file && !file.endsWith('.toml')) return this.tell(t('the name of a netlist ends in .toml'));
    this.over.disabled = this.done.disabled = true; // once is enough
    try {
      const written = await save(file, text, version);
      this.dialog.close();
      onsaved({ file, version: written, text });
    } catch (error) {
      this.tell(error.message, error.there);
      this.show();
    } finally {
      this.over.disabled = this.done.disabled = false;
    }
  }

  // Shows why the file is not saved; `there` is the version of the file that would be replaced.
  tell(why, there = '') {
    this.there = there;
    this.over.hidden = !there;
    this.why.hidden = !why;
    const question = this.isLesson ? t('Overwrite the lesson, or cancel.') : t('Overwrite it, or give another name.');
    this.why.textContent = why && `${t('Not saved: {why}.', { why })}${there ? ` ${question}` : ''}`;
    this.name.toggleAttribute('aria-invalid', Boolean(why));
  }

  show() {
    if (!this.dialog.open) {
      document.body.append(this.dialog);
      this.dialog.showModal();
    }
    if (this.isLesson && this.there) {
      this.over.focus();
      return;
    }
    this.name.focus();
    this.name.select();
  }
}
