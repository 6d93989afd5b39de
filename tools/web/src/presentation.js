// For a room or a class: the question, a large schematic, the plots and the sliders that matter on one screen. The netlist is one
// click away.
import { element } from './dom.js';
import { t } from './messages.js';

export class Presentation {
  // onchange(on): the page has another layout.
  constructor({ onchange }) {
    this.onchange = onchange;
    const button = (text, label, act, extra = {}) => element('button', { type: 'button', onclick: act, 'aria-pressed': 'false', title: label, ...extra }, text);
    this.presentButton = button(t('Present'), t('Question, schematic, plots and sliders on one screen (P)'), () => this.toggle(), { class: 'present' });
    this.netlistButton = button(t('Netlist'), t('The netlist, over the page (E)'), () => this.toggleNetlist(), { class: 'only-presenting' });
    this.screenButton = button('⤢', t('Full screen (F)'), () => this.toggleScreen(), { 'aria-label': t('Full screen') });
    this.buttons = [this.netlistButton, this.presentButton, ...(document.fullscreenEnabled ? [this.screenButton] : [])];
    document.addEventListener('fullscreenchange', () => this.screenButton.setAttribute('aria-pressed', String(Boolean(document.fullscreenElement))));
  }

  get isOn() {
    return document.body.classList.contains('presenting');
  }

  toggle(on = !this.isOn) {
    document.body.classList.toggle('presenting', on);
    this.showNetlist(false);
    this.presentButton.setAttribute('aria-pressed', String(on));
    this.presentButton.textContent = on ? t('End') : t('Present');
    this.presentButton.title = on ? t('Back to all of the page (P)') : t('Question, schematic, plots and sliders on one screen (P)');
    scrollTo(0, 0);
    this.onchange(on);
  }

  toggleNetlist() {
    const { classList } = document.body;
    if (!this.isOn && !classList.contains('in-lesson')) return;
    const open = !classList.contains('netlist-open');
    this.showNetlist(open);
    if (open) document.querySelector('.cm-content')?.focus();
  }

  showNetlist(open) {
    document.body.classList.toggle('netlist-open', open);
    this.netlistButton.setAttribute('aria-pressed', String(open));
  }

  async toggleScreen() {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await document.documentElement.requestFullscreen();
    } catch {
      // The browser does not allow it here; the page stays as it is.
    }
  }
}
