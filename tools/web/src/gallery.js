// The netlists of the folder, to choose from.
import { open, task } from './api.js';
import { element, schematicOf } from './dom.js';
import { aboutLesson, levels, titleOf } from './lesson.js';
import { t } from './messages.js';
import { inWords } from './sections.js';

const words = new Intl.Collator('en', { numeric: true });
const byName = (a, b) => words.compare(titleOf(a), titleOf(b)) || words.compare(a.file, b.file);
// In the order of their first mention in the README of the folder; others come last.
export const inOrder = (a, b) => (a.place ?? Infinity) - (b.place ?? Infinity) || byName(a, b);

// Scenes for beginners come first, scenes that test the solver last.
const rank = (folder) => (folder.startsWith('teaching') ? 0 : folder.startsWith('hard') ? 2 : 1);

// The note below the gallery if the folder has more netlists than it lists.
function leftOutOf(shown, leftOut, allVisited) {
  const values = { shown, others: leftOut };
  const listed = allVisited
    ? t('{shown} netlists are listed; {others} other .toml files of the folder are not.', values)
    : t('{shown} netlists are listed; {others} or more other .toml files of the folder are not.', values);
  return `${listed} ${t('To see them, serve a folder with fewer: rheonet serve FOLDER/SUBFOLDER')}`;
}

export class Gallery {
  // onopen(file): a netlist of the folder is chosen; ontext(name, text): a file of this machine; onnew(): an empty one.
  constructor({ onopen, ontext, onnew }) {
    this.onopen = onopen;
    const chooser = element('input', { type: 'file', accept: '.toml' });
    chooser.addEventListener('change', async () => {
      const [file] = chooser.files;
      chooser.value = '';
      this.dialog.close();
      if (file) ontext(file.name, await file.text());
    });
    this.find = element('input', { type: 'search', placeholder: t('find'), 'aria-label': t('Find netlists') });
    this.level = element('select', { 'aria-label': t('Level') }, element('option', { value: '' }, t('all levels')),
      Object.entries(levels).map(([level, name]) => element('option', { value: level }, name)));
    this.list = element('div', { class: 'cards' });
    this.dialog = element('dialog', { class: 'gallery', 'aria-labelledby': 'gallery-title' },
      element('div', { class: 'dialog-head' }, element('h2', { id: 'gallery-title' }, t('Gallery')), this.find, this.level,
        element('button', { type: 'button', onclick: () => (this.dialog.close(), onnew()) }, t('New scene')),
        element('button', { type: 'button', onclick: () => chooser.click() }, t('Open a file …')),
        element('button', { type: 'button', onclick: () => this.dialog.close(), 'aria-label': t('Close') }, '✕')),
      (this.nothing = element('p', { class: 'note', role: 'status' })), this.list);
    for (const field of [this.find, this.level]) field.addEventListener('input', () => this.filter());
    document.body.append(this.dialog);
    this.drawn = new IntersectionObserver((items) => items.forEach((item) => item.isIntersecting && this.draw(item.target)), { rootMargin: '100px' });
  }

  show({ scenes, left_out: leftOut, all_visited: allVisited }) {
    const groups = new Map();
    this.names = new Map(); // Number of scenes with each title.
    for (const scene of scenes) {
      this.names.set(scene.title, (this.names.get(scene.title) ?? 0) + 1);
      const folder = scene.file.includes('/') ? scene.file.slice(0, scene.file.lastIndexOf('/')) : '';
      if (!groups.has(folder)) groups.set(folder, []);
      groups.get(folder).push(scene);
    }
    const order = [...groups.keys()].sort((a, b) => rank(a) - rank(b) || words.compare(a, b));
    this.list.replaceChildren(...order.map((folder) =>
      element('section', { class: 'card-group' }, folder ? element('h3', {}, folder) : null,
        element('div', { class: 'card-grid' }, groups.get(folder).sort(inOrder).map((scene) => this.card(scene))))));
    if (leftOut || !allVisited) this.list.append(element('p', { class: 'note' }, leftOutOf(scenes.length, leftOut, allVisited)));
    this.level.hidden = !scenes.some((scene) => scene.lesson?.level);
    if (!scenes.length) this.list.append(element('p', { class: 'note' }, t('The folder has no netlists yet: write one in the editor, and save it.')));
  }

  card(scene) {
    const picture = element('div', { class: 'card-picture', 'aria-hidden': 'true' });
    const card = element('button', { type: 'button', class: 'card', 'data-file': scene.file, 'data-level': scene.lesson?.level },
      picture, element('span', { class: 'card-title' }, titleOf(scene)),
      scene.lesson ? element('span', { class: 'card-lesson' }, t('Lesson: {about}', { about: aboutLesson(scene.lesson) })) : null,
      element('span', { class: 'card-about' }, scene.about || scene.file),
      scene.title && scene.about && this.names.get(scene.title) > 1 ? element('code', { class: 'card-file' }, scene.file.split('/').at(-1)) : null);
    card.addEventListener('click', () => {
      this.dialog.close();
      this.onopen(scene.file, Boolean(scene.lesson));
    });
    this.drawn.observe(card);
    return card;
  }

  async draw(card) {
    this.drawn.unobserve(card);
    const picture = card.querySelector('.card-picture');
    try {
      const { text } = await open(card.dataset.file);
      await task({ task: 'show', draw: true, text, file: card.dataset.file }, (message) => {
        if (message.kind === 'scene') picture.replaceChildren(schematicOf(message, { read: false }));
        const wrong = message.kind === 'mistakes' && message.items.find(({ severity }) => severity === 'error');
        if (wrong) this.refuse(card, wrong);
      });
    } catch {
      // A card without its picture still opens.
    }
  }

  // Shows the mistake in place of the summary.
  refuse(card, { line, column, message }) {
    card.querySelector('.card-picture').replaceChildren(element('span', { class: 'note' }, t('no schematic')));
    const about = card.querySelector('.card-about');
    about.replaceChildren(t('It cannot be read: {place}', { place: line ? `${line}:${column}: ` : '' }), ...inWords(message));
    about.classList.add('bad');
  }

  filter() {
    const words = this.find.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const card of this.list.querySelectorAll('.card')) {
      const text = `${card.dataset.file} ${card.textContent}`.toLowerCase();
      card.hidden = !words.every((word) => text.includes(word)) || Boolean(this.level.value && card.dataset.level !== this.level.value);
    }
    for (const group of this.list.querySelectorAll('.card-group')) group.hidden = !group.querySelector('.card:not([hidden])');
    const found = this.list.querySelector('.card:not([hidden])');
    const fits = words.length
      ? t('No netlist has the words “{words}” in its name, title or question.', { words: this.find.value.trim() })
      : t('No netlist has a lesson of this level.');
    this.nothing.textContent = found || !(words.length || this.level.value) ? '' : fits;
  }

  open() {
    this.find.value = this.level.value = '';
    this.filter();
    this.dialog.showModal();
    this.find.focus();
  }
}
