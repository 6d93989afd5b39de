// The language of the page: chosen before, or else the browser's, or else English.
import { use } from './messages.js';
import de from './messages/de.json';
import es from './messages/es.json';
import fr from './messages/fr.json';

const translations = { de, es, fr };
// Each by its own name, for those who do not know the others.
export const languages = { en: 'English', de: 'Deutsch', es: 'Español', fr: 'Français' };

const key = 'language';

function remembered() {
  try {
    return localStorage.getItem(key);
  } catch {
    return null; // without storage it is the browser's
  }
}

export const language = [remembered(), ...navigator.languages.map((each) => each.slice(0, 2).toLowerCase())].find((each) => each in languages) ?? 'en';
use(translations[language] ?? {});
document.documentElement.lang = language;

// The page begins anew in another language: its texts are everywhere.
export function choose(other) {
  try {
    localStorage.setItem(key, other);
  } catch {
    return; // where nothing can be remembered the page stays in the language of the browser
  }
  location.reload();
}
