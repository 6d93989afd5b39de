// The editor of a netlist, with mistakes marked where they are.
import { defaultKeymap, history, historyKeymap, isolateHistory, redo, undo } from '@codemirror/commands';
import { bracketMatching, HighlightStyle, StreamLanguage, syntaxHighlighting } from '@codemirror/language';
import { toml } from '@codemirror/legacy-modes/mode/toml';
import { lintGutter, lintKeymap, setDiagnostics } from '@codemirror/lint';
import { Annotation, EditorState } from '@codemirror/state';
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import { t } from './messages.js';
import { placeIn } from './netlist-text.js';

const colours = HighlightStyle.define([
  { tag: tags.comment, color: 'var(--code-comment)', fontStyle: 'italic' },
  { tag: tags.string, color: 'var(--code-string)' },
  { tag: [tags.number, tags.bool, tags.atom], color: 'var(--code-number)' },
  { tag: [tags.propertyName, tags.variableName, tags.definition(tags.propertyName)], color: 'var(--code-name)' },
]);

const look = EditorView.theme({
  '&': { height: '100%', fontSize: '13px', backgroundColor: 'var(--paper)', color: 'var(--ink)' },
  '.cm-scroller': { fontFamily: "ui-monospace, 'DejaVu Sans Mono', Menlo, Consolas, monospace", lineHeight: '1.5' },
  '.cm-content': { caretColor: 'var(--ink)' },
  '.cm-cursor': { borderLeftColor: 'var(--ink)' },
  '.cm-gutters': { backgroundColor: 'var(--paper)', color: 'var(--faint)', borderRight: '1px solid var(--line)' },
  '.cm-activeLine, .cm-activeLineGutter': { backgroundColor: 'color-mix(in srgb, var(--accent) 7%, transparent)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': {
    backgroundColor: 'color-mix(in srgb, var(--accent) 25%, transparent)',
  },
  '.cm-tooltip .hover, .cm-completionInfo': { maxWidth: '26rem', padding: '0.3rem 0.6rem', overflowWrap: 'anywhere' },
  '.cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]': { backgroundColor: 'var(--accent)', color: 'var(--on-accent)' },
  '.cm-completionDetail': { color: 'inherit' },
  '.cm-tooltip': { backgroundColor: 'var(--paper)', color: 'var(--ink)', border: '1px solid var(--line)' },
});

const sliding = Annotation.define(); // A change by a slider, a preset or a pull. Undo takes those that follow each other at once as one.

export class Editor {
  // onchange(text, byUser, isOther, byHand): `isOther`: another text has taken the place of all of it; `byHand`: not by a slider or a preset; onmove(changes): positions have moved;
  // onundo(): returns whether it has undone something other than a change of the text; `extensions`: of CodeMirror.
  constructor(host, { onchange, onmove, onundo, extensions = [] }) {
    this.extensions = extensions;
    this.onchange = onchange;
    this.onmove = onmove;
    this.onundo = onundo;
    this.view = new EditorView({ parent: host, state: this.stateOf('') });
  }

  stateOf(text) {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), highlightActiveLine(), highlightActiveLineGutter(), drawSelection(), history(), bracketMatching(),
        StreamLanguage.define(toml), syntaxHighlighting(colours), look, lintGutter(), EditorView.lineWrapping, this.extensions,
        EditorView.contentAttributes.of({ 'aria-label': t('Netlist'), tabindex: '0' }),
        keymap.of([{ key: 'Mod-z', run: () => this.onundo() }, ...defaultKeymap, ...historyKeymap, ...lintKeymap]),
        EditorView.updateListener.of((update) => {
          if (!update.docChanged) return;
          this.onmove(update.changes);
          let isOther = false;
          const { length } = update.startState.doc;
          update.changes.iterChangedRanges((from, to) => (isOther ||= length > 0 && from === 0 && to === length));
          this.onchange(this.text, !this.quiet, isOther, update.transactions.some((each) => each.docChanged && !each.annotation(sliding) && !['undo', 'redo'].some((kind) => each.isUserEvent(kind))));
        }),
      ],
    });
  }

  get text() {
    return this.view.state.doc.toString();
  }

  // Loads another text and clears the undo history.
  load(text) {
    this.view.setState(this.stateOf(text));
  }

  // Replaces a part of the text, not as user input.
  replace(from, to, insert) {
    this.replaceAll([{ from, to, insert }]);
  }

  replaceAll(changes) {
    this.quiet = true;
    this.view.dispatch({ changes, annotations: sliding.of(true) });
    this.quiet = false;
  }

  // Changes several places as one undo step, and scrolls to the first.
  edit(changes) {
    this.quiet = true;
    this.view.dispatch({ changes, annotations: isolateHistory.of('full'), effects: EditorView.scrollIntoView(changes[0].from, { y: 'nearest', yMargin: 40 }) });
    this.quiet = false;
  }

  undo() {
    this.quiet = true;
    if (!this.onundo()) undo(this.view);
    this.quiet = false;
  }

  redo() {
    this.quiet = true;
    redo(this.view);
    this.quiet = false;
  }

  // The place of a line and a column (both from 1, in characters).
  offset(line, column) {
    const { doc } = this.view.state;
    if (!line || line > doc.lines) return doc.length;
    const at = doc.line(line);
    return at.from + placeIn(at.text, column);
  }

  mark(mistakes) {
    const { state } = this.view;
    const marks = mistakes
      .filter((mistake) => mistake.line)
      .map(({ line, column, severity, message, hint }) => {
        const from = this.offset(line, column);
        const end = state.doc.lineAt(from).to;
        const word = /^("[^"]*"?|'[^']*'?|[\w.-]+)/.exec(state.sliceDoc(from, end));
        return { from, to: Math.min(end, from + Math.max(1, word ? word[0].length : 1)), severity, message: hint ? `${message}\n${hint}` : message };
      });
    this.view.dispatch(setDiagnostics(state, marks));
  }

  go(line, column) {
    this.goTo(this.offset(line, column));
  }

  goTo(anchor) {
    this.view.dispatch({ selection: { anchor }, effects: EditorView.scrollIntoView(anchor, { y: 'center' }) });
    this.view.focus();
  }
}
