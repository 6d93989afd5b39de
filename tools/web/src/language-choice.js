// The choice of the language in the bar of the page.
import { element } from './dom.js';
import { choose, language, languages } from './language.js';
import { t } from './messages.js';

export function languageChoice() {
  const options = Object.entries(languages).map(([code, name]) => element('option', { value: code, selected: code === language, lang: code }, name));
  const select = element('select', { class: 'language', 'aria-label': t('Language'), title: t('Language') }, options);
  select.addEventListener('change', () => choose(select.value));
  return select;
}
