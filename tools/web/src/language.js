// The language of the page: the user's earlier choice, else the browser's language, else English.
import { use } from './messages.js';
import de from './messages/de.json';
import es from './messages/es.json';
import fr from './messages/fr.json';

const translations = { de, es, fr };
// Each language by its own name.
export const languages = { en: 'English', de: 'Deutsch', es: 'Español', fr: 'Français' };

const key = 'language';

function remembered() {
  try {
    return localStorage.getItem(key);
  } catch {
    return null; // Without storage use the browser's language.
  }
}

export const language = [remembered(), ...navigator.languages.map((each) => each.slice(0, 2).toLowerCase())].find((each) => each in languages) ?? 'en';
use(translations[language] ?? {});
document.documentElement.lang = language;

// Stores the language and reloads the page, whose texts are in many places.
export function choose(other) {
  try {
    localStorage.setItem(key, other);
  } catch {
    return; // Without storage the page stays in the browser's language.
  }
  location.reload();
}
