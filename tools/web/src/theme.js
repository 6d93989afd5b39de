// Light or dark: as the system has it, until somebody switches. The page has one of the two at any time, in `data-theme`.

const dark = matchMedia('(prefers-color-scheme: dark)');
const root = document.documentElement;
let chosen = null;

function follow() {
  root.dataset.theme = chosen ?? (dark.matches ? 'dark' : 'light');
}

export function followSystem() {
  dark.addEventListener('change', follow);
  follow();
}

export function switchTheme() {
  chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
  follow();
  try {
    localStorage.setItem('theme', chosen);
  } catch {
    // It is remembered where that is allowed.
  }
}

export function rememberTheme() {
  try {
    const theme = localStorage.getItem('theme');
    if (theme === 'dark' || theme === 'light') chosen = theme;
  } catch {
    // The system's theme then.
  }
}
