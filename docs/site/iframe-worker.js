// The worker of the search. mkdocs-material's own plugin for pages from the disk loads a script from another machine;
// this does the same, so that nothing is asked of anybody. Names of options and systems are words to look for, and not its notation for queries; and
// in pages that were opened from the disk, where browsers allow no workers, a hidden frame does the work instead.
const query = 2;
const plain = message => message.type !== query ? message
  : { ...message, data: message.data.replace(/(^|\s)-+(?=\S)/g, "$1").replace(/[:~^]+/g, " ") };

const FramedWorker = class extends EventTarget {
  constructor(address) {
    super();
    const frame = document.createElement("iframe");
    frame.hidden = true;
    this.waiting = [];
    frame.onload = () => {
      const inside = frame.contentWindow;
      const load = url => new Promise((done, failed) => {
        const script = inside.document.createElement("script");
        script.src = url;
        script.onload = done;
        script.onerror = failed;
        inside.document.body.append(script);
      });
      const receive = data => {
        const event = new MessageEvent("message", { data });
        this.dispatchEvent(event);
        if (this.onmessage) this.onmessage(event);
      };
      inside.importScripts = (...urls) =>
        urls.reduce((before, url) => before.then(() => load(url)), Promise.resolve());
      inside.postMessage = receive;
      load(new URL(address, location.href).href).then(() => {
        this.inside = inside;
        this.waiting.forEach(data => this.postMessage(data));
      });
    };
    document.body.append(frame);
  }
  postMessage(data) {
    if (!this.inside) { this.waiting.push(data); return; }
    this.inside.dispatchEvent(new MessageEvent("message", { data }));
  }
  terminate() {}
};

window.Worker = class extends (location.protocol === "file:" ? FramedWorker : Worker) {
  postMessage(message) { super.postMessage(plain(message)); }
};
