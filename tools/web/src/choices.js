// The choice of the variant that is edited.
import { element } from './dom.js';
import { t } from './messages.js';

export function choices(variants, active, onchoose) {
  return variants.map(({ label }, k) => {
    const input = element('input', { type: 'radio', name: 'variant', checked: k === active });
    input.addEventListener('change', () => onchoose(k));
    return element('label', {}, input, element('span', {}, t('Edit {label}', { label })));
  });
}
