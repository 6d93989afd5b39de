// A scene and its run, collected from the messages in tools/report/messages.hpp.

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64); // ten times as fast; browsers have it since 2025
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

// The columns of a message of rows: the times, then the values of each record.
function columnsOf({ count, columns }) {
  const all = new Float64Array(bytesOf(columns).buffer); // Browsers run on machines that store the lowest byte first.
  return Array.from({ length: all.length / count }, (_, k) => all.subarray(k * count, (k + 1) * count));
}

export class SceneData {
  constructor() {
    this.mistakes = [];
    this.scene = null;
    this.explanation = null;
    this.time = [];
    this.columns = [];
    this.energy = null;
    this.events = { items: [], left_out: 0 };
    this.done = null;
    this.failed = null;
    this.certificate = null;
    this.prices = null;
  }

  take(message) {
    switch (message.kind) {
      case 'mistakes':
        this.mistakes = message.items;
        break;
      case 'scene':
        this.scene = message;
        this.columns = message.records.map(() => []);
        this.index = new Map(message.records.map((record, k) => [record.path, k]));
        break;
      case 'rows':
        columnsOf(message).forEach((values, k) => {
          const column = k ? this.columns[k - 1] : this.time;
          for (let i = 0; i < values.length; ++i) column.push(values[i]);
        });
        break;
      default:
        this[message.kind] = message;
    }
  }

  static from(messages) {
    const data = new SceneData();
    messages.forEach((message) => data.take(message));
    return data;
  }

  get records() {
    return this.scene?.records ?? [];
  }

  // Whether there are rows beyond the start.
  get hasCurves() {
    return this.time.length > 1 && this.time.at(-1) > this.time[0];
  }

  // The time that the run takes; a condition may end it before its `stop`.
  get span() {
    const { start, stop } = this.scene;
    return { start, stop: this.done && this.hasCurves ? this.time.at(-1) : stop };
  }

  // Whether there is an energy account; a run that was cut short has none.
  get hasEnergy() {
    return Boolean(this.energy) && this.energy.time.length > 1;
  }

  column(path) {
    const k = this.index?.get(path);
    return k === undefined ? null : this.columns[k];
  }

  // Elements and assemblies, or nodes, that both channels are known of.
  ownersOf(first, second) {
    const has = (owner, channel) => this.index?.has(`${owner}.${channel}`);
    const owners = [...new Set(this.records.map((record) => record.owner))];
    return owners.filter((owner) => has(owner, first) && has(owner, second));
  }

  // The position in `time` that is nearest to t.
  at(t) {
    let low = 0;
    let high = this.time.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle] <= t) low = middle;
      else high = middle;
    }
    return high >= 0 && Math.abs(this.time[high] - t) < Math.abs(this.time[low] - t) ? high : Math.max(low, 0);
  }
}
