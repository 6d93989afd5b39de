// Sources and destinations of netlists: the folder, links, the browser's history, exported files.
import { folder, open } from './api.js';
import { download, exporters } from './export.js';
import { firstScene } from './first-scene.js';
import { Gallery, inOrder } from './gallery.js';
import { LessonDialog } from './lesson-dialog.js';
import { lessonFileOf } from './lesson-text.js';
import { titleOf } from './lesson.js';
import { decode, encode } from './link.js';
import { t } from './messages.js';
import { isReachable, showCode, showFrame, unreachable } from './qr-dialog.js';
import { SaveDialog } from './save-dialog.js';

const pause = 400; // Delay after a change until it is kept [ms]: browsers limit the rate of writes to the history.

const folderOf = (file) => file.slice(0, file.lastIndexOf('/') + 1);

export class Files {
  constructor(desk) {
    this.desk = desk;
    this.folder = { scenes: [], may_be_written: false };
    this.gallery = new Gallery({ onopen: (file, isLesson) => this.openFile(file, true, isLesson), ontext: (file, text) => this.openText(file, text), onnew: () => this.desk.beginAnew() });
    this.saving = new SaveDialog();
    this.writing = new LessonDialog({ ondone: (text) => this.preview(text) });
    addEventListener('popstate', (event) => {
      this.writing.close();
      this.openAddress(event.state);
    });
    addEventListener('beforeunload', () => this.keep());
  }

  async begin() {
    await this.look();
    if ((await this.openAddress(history.state)) || this.desk.notice) return;
    if (this.folder.scenes.length && !document.body.classList.contains('embedded')) this.gallery.open();
  }

  async look() {
    try {
      this.folder = await folder();
      this.gallery.show(this.folder);
    } catch (error) {
      this.desk.say(error.message, true);
    }
  }

  // Opens the scene of the address, or else the first scene. Unsaved changes are restored, and so is a lesson.
  async openAddress(left) {
    if (left?.scenes) this.desk.begin(left, left.scenes.some(({ text, opened }) => text !== opened) ? t('The netlist is as you left it; it is not saved.') : '');
    else if (await this.openLink()) return true;
    else this.desk.begin({ scenes: [{ text: firstScene, file: 'scene.toml' }] });
    return Boolean(left?.scenes);
  }

  async openLink() {
    const [kind, value] = location.hash.slice(1).split(/=(.*)/s);
    try {
      if (kind === 'file' || kind === 'lesson') return await this.openFile(decodeURIComponent(value), false, kind === 'lesson');
      if (kind !== 'scene' && kind !== 's') return false;
      const { scenes, plots } = decode(kind, value);
      this.desk.begin({ scenes: scenes.slice(0, 2).map(({ text, file, lesson }) => ({ text: String(text), file: String(file), lesson: lesson && { text: String(lesson.text) } })), plots, lesson: Boolean(scenes[0].lesson) });
      return true;
    } catch {
      // The browser's message (on characters and compression) would not help the user.
      this.desk.notify(t('The link cannot be read: a part of it is missing, or was changed on its way. Ask for it once more.'));
      return false;
    }
  }

  // The netlists beside this one that have a lesson, in the order of the gallery.
  lessons() {
    return this.folder.scenes.filter(({ file, lesson }) => lesson && folderOf(file) === folderOf(this.desk.current.file)).sort(inOrder);
  }

  // The title of this netlist in the language of the page; `title`: in its text.
  titleHere(title) {
    const listed = this.folder?.scenes.find(({ file }) => file === this.desk.current.file);
    return listed?.title === title ? titleOf(listed) : title;
  }

  // `anew`: there is a way back to what was there before; `lesson`: the netlist is opened for its lesson.
  async openFile(file, anew = false, lesson = false) {
    try {
      const { text, version } = await open(file);
      if (anew) this.keep();
      this.nameInAddress(file, anew, lesson);
      this.desk.begin({ scenes: [{ text, file, version }], lesson });
      scrollTo(0, 0);
      return true;
    } catch (error) {
      this.desk[anew ? 'say' : 'notify'](`${file}: ${error.message}`, true);
      return false;
    }
  }

  // Leaves the scenes for others, with a new entry in the browser's history.
  leave(to = location.pathname + location.search) {
    this.keep(true);
    history.pushState(null, '', to);
  }

  // Begins the lesson again, or leaves it. A lesson that is in no folder stays with its netlist.
  reopen(lesson) {
    const scene = this.asOpened;
    if (!scene.lesson) return this.openFile(scene.file, true, lesson);
    this.leave(lesson ? location.href : undefined);
    this.desk.begin({ scenes: [scene], lesson });
  }

  // The scene that is saved and sent. While a lesson is open its steps change values by presets and sliders: they are left out, unless the text
  // was edited by hand.
  get asOpened() {
    const { current, course } = this.desk;
    const { text, opened, file, version, lesson, byHand } = current;
    return { text: course.isOn && !byHand ? opened : text, file, version, lesson };
  }

  // A file of this machine, which the folder does not hold.
  openText(file, text) {
    this.leave();
    this.desk.begin({ scenes: [{ text, file }] });
    scrollTo(0, 0);
  }

  // Makes a lesson of the netlist, or edits the one that it has.
  async editLesson() {
    const { desk } = this;
    const { current } = desk;
    const { file, text, data, stale } = current;
    if (!data.scene || stale) return desk.answer(data.failed?.message ?? t('The netlist has mistakes.'), true);
    const { href } = location;
    try {
      const name = lessonFileOf(file);
      this.edited = current.lesson ?? (this.hasLesson ? await open(name) : { text: '', version: '' });
      if (desk.current !== current || current.file !== file || current.text !== text || location.href !== href) return; // another scene meanwhile, or on the way to one
      this.writing.open({ file, text: this.asOpened.text, lesson: this.edited.text, data, first: desk.plots.drawnCurves()[0]?.[0]?.y });
    } catch (error) {
      desk.answer(error.message, true);
    }
  }

  // A lesson that has been written, as a student sees it.
  preview(text) {
    const { desk } = this;
    const scene = { ...this.asOpened, lesson: { text, version: this.edited.version, isOwn: true } };
    this.leave(location.href);
    desk.begin({ scenes: [scene], lesson: true });
    this.keep();
    desk.answer(t('This is what students see. Save and Link hold the lesson too.'));
  }

  // Whether the folder has a lesson of the netlist.
  get hasLesson() {
    const { file, version } = this.desk.current;
    return Boolean(version) && this.folder.scenes.some((scene) => scene.file === file && scene.lesson);
  }

  nameInAddress(file, anew = false, lesson = false) {
    history[anew ? 'pushState' : 'replaceState'](null, '', `#${lesson ? 'lesson' : 'file'}=${encodeURIComponent(file)}`);
  }

  changed() {
    clearTimeout(this.later);
    this.later = setTimeout(() => this.keep(), pause);
  }

  // Keeps unsaved changes and a lesson in the browser's history, for going back or reloading.
  keep(always = false) {
    clearTimeout(this.later);
    const { variants, active, plots, course } = this.desk;
    const lesson = course.state;
    const unsaved = always || lesson || variants.some(({ text, opened, lesson: own }) => own || text !== opened);
    const scenes = variants.map(({ text, file, version, opened, byHand, lesson: own }) => ({ text, file, version, opened, byHand, lesson: own }));
    try {
      history.replaceState(unsaved ? { scenes, active, plots: plots.state, lesson } : null, '', location.href);
    } catch {
      // Texts that are too long are not kept.
    }
  }

  get name() {
    return this.desk.current.file.replace(/^.*\//, '').replace(/\.toml$/, '');
  }

  saves() {
    const { current } = this.desk;
    const { file, version, lesson } = current;
    const here = this.folder.may_be_written;
    return [
      here && version && { label: t('Save as {file}', { file: lesson ? `${file}, ${lessonFileOf(file)}` : file }), act: () => this.save() },
      here && { label: t('Save in the folder as …'), act: () => this.saving.saveAs(this.asOpened, (saved) => this.savedNetlist(current, saved)) },
      { label: t('Download the netlist'), act: () => this.downloadNetlist() },
      lesson && { label: t('Download the lesson'), act: () => download(new Blob([lesson.text], { type: 'application/toml' }), `${this.name}.lesson`) },
      { label: lesson || this.hasLesson ? t('Edit the lesson') : t('Make a lesson'), act: () => this.editLesson() },
    ].filter(Boolean);
  }

  save() {
    const { current } = this.desk;
    if (this.folder.may_be_written) this.saving.save(this.asOpened, (saved) => this.savedNetlist(current, saved));
    else this.downloadNetlist();
  }

  downloadNetlist() {
    download(new Blob([this.asOpened.text], { type: 'application/toml' }), `${this.name}.toml`);
  }

  // The netlist of a variant has been saved; its lesson is saved after it, beside it.
  savedNetlist(variant, { file, version, text }) {
    const lesson = variant.lesson && { ...variant.lesson, version: file === variant.file ? variant.lesson.version ?? '' : '' };
    Object.assign(variant, { file, version, lesson, opened: text, byHand: false });
    if (lesson) this.saving.saveLesson({ ...lesson, file: lessonFileOf(file) }, (saved) => this.savedLesson(variant, saved));
    return this.saved(file);
  }

  savedLesson(variant, { file }) {
    variant.lesson = null;
    return this.saved(file);
  }

  async saved(file) {
    const { desk } = this;
    const { current } = desk;
    this.nameInAddress(current.file, false, desk.course.isOn);
    this.keep();
    desk.showTitle(current.data.scene?.title);
    desk.answer(t('Saved as {file}.', { file }));
    await this.look();
  }

  exports() {
    const { desk } = this;
    const scenes = desk.variants.map(({ text, file }) => ({ text, file }));
    const curves = desk.plots.drawnCurves();
    const drawn = desk.plots.runs.map(({ text, file }, k) => ({ text, file, curves: curves[k] }));
    return exporters({ scenes, active: desk.active, drawn, schematic: desk.current.data.scene?.schematic ?? '', name: this.name })
      .map((exporter) => ({ label: exporter.label, act: () => this.export(exporter) }))
      .concat({ label: t('Link as a QR code'), act: () => showCode(this.putInAddress()) }, { label: t('Code for another page …'), act: () => showFrame(this.putInAddress()) });
  }

  async export({ make, name }) {
    const { desk } = this;
    desk.say(t('Making {name} …', { name }));
    try {
      download(await make(), name);
      desk.answer(t('Made {name}.', { name }));
    } catch (error) {
      desk.answer(t('Not made: {why}', { why: error.message }), true);
    }
  }

  // The address of the page carries the scene from now on; that of a lesson opens the lesson.
  putInAddress() {
    const { course, variants, plots } = this.desk;
    const { asOpened } = this;
    const scenes = course.isOn ? [asOpened] : variants.map(({ file, text }) => ({ file, text }));
    const hash = course.isOn && !asOpened.lesson ? location.hash : `#${encode({ scenes, plots: plots.state })}`;
    // A server that others can reach gives a key for them.
    const link = `${this.folder.link ?? ''}${hash}`;
    history.replaceState(history.state, '', link.startsWith(location.origin) ? link : hash);
    return this.folder.link ? link : location.href;
  }

  async copyLink() {
    const address = this.putInAddress();
    const isLesson = this.desk.course.isOn;
    const limits = location.protocol === 'file:' ? t('It opens only where this file is at the same place.') : isReachable(address) ? '' : unreachable();
    let text = isLesson ? t('The link is copied: it opens the lesson.') : t('The link is copied: it carries the scene.');
    try {
      await navigator.clipboard.writeText(address);
    } catch {
      text = isLesson ? t('The address of this page opens the lesson.') : t('The address of this page carries the scene.');
    }
    this.desk.answer([text, limits].filter(Boolean).join(' '));
  }
}
