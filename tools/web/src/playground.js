// The playground: a netlist in an editor, its schematic, its sliders and its plots, which follow each other.
import { language } from './language.js'; // first: the modules below have texts
import './style.css';
import './playground.css';
import './motion.css';
import './presentation.css';
import { Animation } from './animation.js';
import { Beside } from './beside.js';
import { Drawing } from './drawing.js';
import { element, rewriteTexts, schematicOf, tellMore } from './dom.js';
import { Editor } from './editor.js';
import { choices } from './choices.js';
import { DrawingView } from './drawing-view.js';
import { assistance } from './completion.js';
import { Files } from './files.js';
import { emptyScene, firstScene } from './first-scene.js';
import { Folds } from './folds.js';
import { helpDialog } from './help.js';
import { listenToKeys } from './keys.js';
import { languageChoice } from './language-choice.js';
import { Lesson } from './lesson.js';
import { menu } from './menu.js';
import { t } from './messages.js';
import { PlotPanel } from './plot-panel.js';
import { Presentation } from './presentation.js';
import { Runner } from './runner.js';
import { SceneData } from './scene-data.js';
import { lessonOf } from './sections.js';
import { Sliders } from './sliders.js';
import { followSystem, rememberTheme, switchTheme } from './theme.js';
import { Traces } from './traces.js';
import { runTime } from './units.js';

const isEmbedded = new URLSearchParams(location.search).has('embed');
const typing = 250; // Pause in typing after which the text is simulated [ms].

class Playground {
  constructor(host) {
    this.variants = [this.variant('A', firstScene, 'scene.toml')];
    this.active = 0;
    this.files = new Files(this);
    this.beside = new Beside();
    this.build(host);
    this.editor = new Editor(this.parts.editor, {
      onchange: (text, typed, isOther, byHand) => this.edited(text, typed, isOther, byHand),
      onmove: (changes) => {
        this.sliders?.move(changes);
        this.drawing?.inspector.move(changes);
      },
      onundo: () => this.revoke(),
      extensions: assistance(() => this.drawing),
    });
    this.sliders = new Sliders(this.parts.sliders, this.editor);
    this.traces = new Traces(() => this.showPlots());
    this.plots = new PlotPanel(this.parts.plots, { onchange: () => this.showSections(), fits: true, traces: this.traces });
    this.folds = new Folds(this.parts.sections, () => this.request(), (path, value) => this.sliders.slide(path, value));
    this.animation = new Animation(this.parts.animation, { onframe: (time) => this.plots.mark(time), onmove: (shiftOf) => this.drawing.handles.follow(shiftOf), follower: this.beside.animation });
    this.course = new Lesson(this.lesson, {
      sliders: this.sliders, language,
      others: () => this.files.lessons(),
      onopen: (file) => this.files.openFile(file, true, true),
      onagain: () => this.files.reopen(true),
      onleave: () => this.files.reopen(false),
      onedit: () => this.files.editLesson(),
    });
    this.drawing = new Drawing(this, { drawing: this.parts.drawing, bar: this.parts.draw, cards: this.parts.inspector });
    const { presentation } = this;
    listenToKeys({
      save: () => this.files.save(),
      acts: {
        ' ': () => this.course.isConcealing || this.animation.toggle(),
        g: () => this.files.gallery.open(),
        p: () => presentation.toggle(),
        f: () => presentation.toggleScreen(),
        e: () => presentation.toggleNetlist(),
        r: () => this.sliders.reset(),
        t: () => this.traces.freeze(),
        m: () => this.plots.measure.toggle(),
        h: () => this.plots.hold(!this.plots.isHeld),
        escape: () => presentation.isOn && presentation.toggle(false),
      },
    });
    if (new URLSearchParams(location.search).has('present')) presentation.toggle(true);
  }

  variant(label, text, file) {
    const variant = { label, text, file, version: '', opened: text, data: new SceneData(), stale: false };
    const session = crypto.getRandomValues(new Uint32Array(2)).join('-');
    variant.runner = new Runner(session, (data, run) => this.arrived(variant, data, run), (data, read) => this.wasRead(variant, data, read));
    return variant;
  }

  get current() {
    return this.variants[this.active];
  }

  build(host) {
    const part = (name, tag = 'div', ...content) => (this.parts[name] = element(tag, { class: name }, ...content));
    const button = (text, act, extra = {}) => element('button', { type: 'button', onclick: act, ...extra }, text);
    this.parts = {};
    this.title = element('h1', {}, 'rheonet');
    this.presentation = new Presentation({ onchange: (on) => this.present(on) });
    this.compareButton = button(t('Compare'), () => this.compare(), { 'aria-pressed': 'false' });
    this.status = element('p', { class: 'status', role: 'status' });
    this.themeButton = button('◐', switchTheme, { 'aria-label': t('Light or dark'), title: t('Light or dark') });
    const bar = element('header', { class: 'bar' }, this.title, element('nav', { class: 'actions', 'aria-label': t('Actions') },
      button(t('Gallery'), () => this.files.gallery.open()),
      button(t('New'), () => this.beginAnew(), { title: t('An empty scene to draw in') }),
      button(t('Make a lesson'), () => this.files.editLesson(), { class: 'make-lesson' }),
      menu(t('Save'), () => this.files.saves()),
      menu(t('Export'), () => this.files.exports()),
      button(t('Link'), () => this.files.copyLink()),
      this.compareButton, ...this.presentation.buttons, languageChoice(), this.themeButton,
      button('?', () => this.help.showModal(), { 'aria-label': t('Help') })));
    this.choice = element('div', { class: 'variants', role: 'radiogroup', 'aria-label': t('Variant that is edited'), hidden: true });
    const box = (name, heading, ...content) => element('section', { class: `box ${name}-box`, 'aria-label': heading }, element('h2', { class: 'box-title' }, heading), ...content);
    host.append(bar, element('main', { class: 'desk' },
      box('editor', t('Netlist'), this.choice, part('editor'), part('mistakes')),
      // Before the stage: that is the order of the Tab key.
      box('sliders', t('Sliders'), part('inspector', 'section'), part('sliders'),
        button(t('Sweep'), () => this.folds.openSweep(this.sliders.latest?.path), { class: 'to-sweep', title: t('Runs the scene for many values of a number, and draws a measure of each run.') })),
      element('div', { class: 'stage' },
        element('div', { class: 'view' },
          (this.lesson = box('lesson', t('Question'))),
          box('schematic', t('Schematic'), part('draw'), element('div', { class: 'drawings' }, part('drawing'), this.beside.host), part('animation')),
          box('plots', t('Plots'), this.status, part('plots'))),
        box('more', t('More'), part('sections')))));
    tellMore(this.parts.mistakes);
    this.view = new DrawingView(this.parts.drawing);
    this.parts.drawing.parentNode.before(this.view.controls);
    this.beside.join(this.parts.drawing, this.view);
    new ResizeObserver(() => document.body.style.setProperty('--bar', `${bar.offsetHeight}px`)).observe(bar);
    this.lesson.hidden = true;
    this.toast = element('p', { class: 'toast', hidden: true, 'aria-hidden': 'true' });
    host.append(this.toast);
    if (isEmbedded) this.embed(bar);
    this.help = helpDialog();
    document.body.append(this.help);
  }

  present(on) {
    this.view.most = on ? 2.5 : 1;
    this.view.place();
    this.plots.fit();
  }

  // Embedded in a foreign page: shows only a link to the whole playground in place of the tools.
  embed(bar) {
    document.body.classList.add('embedded');
    const link = element('a', { target: '_blank' }, t('Open in the playground'));
    const follow = () => (link.href = `${location.origin === 'null' ? 'file://' : location.origin}${location.pathname}${location.hash}`);
    for (const event of ['hashchange', 'popstate']) addEventListener(event, follow);
    follow();
    bar.append(link);
  }

  // Replaces all scenes by one scene, or by two to compare.
  begin({ scenes, active = scenes.length - 1, plots = {}, lesson = false }, notice = '') {
    this.endComparison();
    this.revocable = null;
    this.course.end();
    this.presentation.showNetlist(false);
    this.folds.renew();
    this.traces.clear();
    this.plots.state = plots ?? {};
    if (notice) this.notify(notice);
    scenes.slice(1).forEach(({ text, file }) => this.variants.push(this.variant('B', text, file)));
    this.active = scenes[active] ? active : 0;
    this.showChoice();
    scenes.forEach((scene, k) => this.load(k, scene));
    if (lesson) this.course.begin(scenes[0], lesson);
  }

  beginAnew() {
    this.files.leave();
    this.begin({ scenes: [{ text: emptyScene, file: 'scene.toml' }] });
    this.drawing.switch(true);
    this.offerBack(t('A new scene. Undo brings back the one before.'));
  }

  // Offers to undo the last replacement of the scenes. Undo works while the text is the one that replaced them.
  offerBack(text) {
    this.revocable = { text: this.current.text };
    this.answer(text, false, () => this.revoke());
  }

  revoke() {
    if (this.revocable?.text !== this.current.text) return false;
    this.revocable = null;
    this.toast.hidden = true;
    history.back();
    return true;
  }

  // Texts and runs.

  // `version` is that of the file of the folder that has this text, or has the text `opened`, from which this one was made.
  // `byHand`: it was edited otherwise than by sliders and presets.
  // `lesson` { text, version, isOwn }: one that is not that of the folder, the version of which it replaces; `isOwn`: it was written here.
  load(k, { text, file, version = '', opened = text, lesson = null, byHand = false }) {
    const variant = this.variants[k];
    Object.assign(variant, { text, file, version, opened, lesson, byHand, answered: null, fresh: true });
    this.folds.stop();
    if (k === this.active) {
      this.editor.load(text);
      this.clear();
    }
    this.showBusy();
    clearTimeout(this.typing); // of the text before
    variant.runner.run(text, file);
  }

  // Clears everything that belongs to the scene before.
  clear() {
    this.sliders.clear();
    this.parts.drawing.replaceChildren();
    this.view.attach();
    this.parts.animation.hidden = true;
    this.drawn = null;
    this.showBeside();
    this.drawing.clear();
    this.showTitle('');
    this.showLesson({});
  }

  wasRead(variant, data, read) {
    if (variant !== this.current || read !== variant.text) return;
    this.drawing.known(data.scene, read);
    if (variant.fresh) variant.first = data.scene.sliders.map((knob) => ({ ...knob }));
    this.sliders.show(data.scene.sliders, variant.fresh, variant.first);
    if (variant.fresh) this.showSchematic(data.scene);
    variant.fresh = false;
  }

  edited(text, typed, isOther, byHand) {
    const variant = this.current;
    variant.byHand = text !== variant.opened && (variant.byHand || byHand);
    variant.text = text;
    if (isOther) {
      variant.fresh = true;
      this.folds.renew();
    }
    this.showBusy();
    this.folds.stop();
    this.files.changed();
    this.drawing?.follow();
    clearTimeout(this.typing);
    if (typed) this.typing = setTimeout(() => variant.runner.run(text, variant.file), typing);
    else variant.runner.run(text, variant.file);
  }

  arrived(variant, data, { text, complete, asked }) {
    const isCurrent = variant === this.current;
    if (complete) variant.answered = text;
    this.showBusy();
    if (complete && isCurrent && data.mistakes.length === 1 && this.drawing.isEmpty) {
      // A new scene without elements is not a mistake.
      this.showMistakes({ mistakes: [] }, text === variant.text);
      this.parts.plots.hidden = true;
      this.say(t('Nothing to run yet: choose an element, then click where its ends go.'));
      return;
    }
    if (complete && isCurrent) this.showMistakes(data, text === variant.text);
    if (!data.scene) {
      variant.stale = true;
      this.showStale();
      if (complete) this.say(data.failed ? data.failed.message : variant.data.hasCurves ? t('The netlist has mistakes; the plots show what was there before.') : t('The netlist has mistakes.'), true);
      return;
    }
    if (data.time.length || complete) Object.assign(variant, { data, shown: text });
    variant.stale = false;
    if (isCurrent) this.showScene(data);
    else if (this.current.data.scene) this.showMotion(this.current.data);
    this.showPlots();
    if (complete) this.finish(data, asked);
  }

  finish(data, asked) {
    this.showStale();
    clearTimeout(this.later);
    this.later = setTimeout(() => this.showSections(), 200);
    if (data.failed) {
      // Without curves the reason is shown in their place.
      this.say(data.hasCurves ? t('The run did not come to its end: {why}', { why: data.failed.message }) : t('The run did not come to its end.'), true);
      return;
    }
    requestAnimationFrame(() => {
      const took = performance.now() - asked;
      this.status.dataset.latency = took.toFixed(1);
      if (this.notice) {
        this.say(this.notice, true);
        this.notice = null;
        return;
      }
      const { statistics } = data.done;
      const values = { steps: statistics.steps, time: runTime(statistics), took: Math.round(took) };
      this.say(statistics.steps === 1 ? t('One step, {time}; drawn {took} ms after the change', values) : t('{steps} steps, {time}; drawn {took} ms after the change', values));
    });
  }

  // The outcome of an action, wherever the page has been scrolled to.
  answer(text, bad = false, undo = null) {
    this.say(text, bad);
    this.toast.replaceChildren(text, ...(undo ? [' ', element('button', { type: 'button', onclick: undo }, t('Undo'))] : []));
    this.toast.setAttribute('aria-hidden', String(!undo));
    this.toast.hidden = false;
    clearTimeout(this.toasted);
    this.toasted = setTimeout(() => (this.toast.hidden = true), undo || text.length > 100 ? 8000 : 4000);
  }

  // Stays until the next change.
  notify(text) {
    this.notice = text;
    this.say(text, true);
  }

  say(text, bad = false) {
    this.status.textContent = text;
    this.status.classList.toggle('bad', bad);
  }

  // What is seen.

  showScene(data) {
    const { scene } = data;
    this.showTitle(scene.title);
    this.showLesson(scene);
    this.showSchematic(scene);
    // Until there are rows the motion is that of the run before.
    if (data.hasCurves || data.done || data.failed) this.showMotion(data);
    this.course.take(data, this.current.shown ?? this.current.text);
  }

  showTitle(title) {
    this.title.textContent = this.files.titleHere(title) || this.current.file;
    document.title = `${this.title.textContent} – rheonet`;
  }

  showSchematic(scene) {
    const before = this.drawn;
    this.drawn = scene;
    if (rewriteTexts(this.parts.drawing.querySelector('.schematic svg'), before, scene)) {
      if (before.schematic !== scene.schematic) this.animation.textsChanged();
      return;
    }
    this.parts.drawing.replaceChildren(schematicOf(scene));
    this.drawing.attach(scene);
  }

  showMotion(data) {
    this.showBeside();
    this.animation.attach(this.parts.drawing.querySelector('svg'), data, this.variants[1 - this.active]?.data);
  }

  // The variant that is compared with the current one: A is before B.
  showBeside() {
    this.beside.show(this.current, this.variants[1 - this.active] ?? null, this.active === 1);
  }

  showLesson(scene) {
    const words = JSON.stringify(scene.demo ?? null);
    if (words === this.words) return;
    this.words = words;
    this.lesson.hidden = !scene.demo && !this.course.isOn;
    this.lesson.querySelector('.lesson')?.remove();
    if (scene.demo) this.lesson.append(lessonOf(scene, true));
  }

  showPlots() {
    const several = this.variants.length > 1;
    this.parts.plots.hidden = false;
    this.traces.offer(this.current);
    const now = this.variants.map(({ label, data, text, shown, file }) => ({ label: several ? label : this.traces.all.length ? t('now') : '', data, text: shown ?? text, file }));
    this.plots.show([...now, ...this.traces.all]);
  }

  // Shows the page as busy until everything visible belongs to the current texts.
  showBusy() {
    this.parts.plots.setAttribute('aria-busy', String(this.variants.some(({ text, answered }) => text !== answered)));
  }

  showStale() {
    this.parts.plots.classList.toggle('stale', this.variants.some(({ stale }) => stale));
    this.parts.drawing.classList.toggle('stale', this.current.stale);
  }

  showMistakes(data, isNew) {
    if (isNew) this.drawing.told(data.mistakes);
    if (isNew) this.editor.mark([...data.mistakes, ...(data.failed?.line ? [{ ...data.failed, severity: 'error' }] : [])]);
    this.parts.mistakes.replaceChildren(...data.mistakes.map(({ severity, line, column, message, hint }) =>
      element('button', { type: 'button', class: `mistake ${severity}`, onclick: () => line && this.editor.go(line, column) },
        element('b', {}, line ? `${line}:${column} ` : ''), message, hint ? element('span', { class: 'hint' }, ` – ${hint}`) : null)));
  }

  request() {
    const { text, file, runner } = this.current;
    return { text, file, session: runner.session };
  }

  showSections() {
    if (this.current.data.scene) this.folds.show(this.current.data, this.variants.map(({ label, data }) => ({ label, data })));
  }

  // Two variants.

  compare() {
    if (this.variants.length > 1) {
      this.files.leave(location.href);
      this.endComparison();
      this.showBeside();
      this.showPlots();
      this.showSections();
      this.offerBack(t('The comparison has ended. Undo brings it back.'));
      return;
    }
    const { text, file, version, opened, data, shown, lesson } = this.current;
    const other = this.variant('B', text, file);
    Object.assign(other, { data, shown });
    this.variants.push(other);
    this.edit(1);
    this.load(1, { text, file, version, opened, lesson });
  }

  endComparison() {
    if (this.variants.length > 1) {
      // Keep the variant that was edited last.
      const kept = this.variants[this.active];
      kept.label = 'A';
      this.variants = [kept];
    }
    this.active = 0;
    this.showChoice();
    this.showBusy();
  }

  edit(k) {
    this.active = k;
    this.showChoice();
    const { text, data, shown } = this.current;
    this.editor.load(text);
    this.clear();
    if (data.scene) {
      this.drawing.known(data.scene, shown);
      if (shown === text) this.sliders.show(data.scene.sliders, true, this.current.first);
      this.showScene(data);
      this.showMistakes(data, true);
    }
  }

  showChoice() {
    const several = this.variants.length > 1;
    this.choice.hidden = !several;
    this.compareButton.setAttribute('aria-pressed', String(several));
    this.compareButton.textContent = several ? t('End comparison') : t('Compare');
    this.choice.replaceChildren(...choices(several ? this.variants : [], this.active, (k) => {
      this.edit(k);
      this.choice.querySelectorAll('input')[k].focus();
    }));
    this.choice.classList.add('tabs');
  }
}

rememberTheme();
followSystem();
new Playground(document.getElementById('playground')).files.begin();
