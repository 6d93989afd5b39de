// Light or dark: as the system has it, until somebody switches.

const chosen = () => document.documentElement.dataset.theme;

export function switchTheme() {
  const system = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
  const theme = (chosen() ?? system) === 'dark' ? 'light' : 'dark';
  document.documentElement.dataset.theme = theme;
  try {
    localStorage.setItem('theme', theme);
  } catch {
    // It is remembered where that is allowed.
  }
}

export function rememberTheme() {
  try {
    const theme = localStorage.getItem('theme');
    if (theme) document.documentElement.dataset.theme = theme;
  } catch {
    // The system's theme then.
  }
}
