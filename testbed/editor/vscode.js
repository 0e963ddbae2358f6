// Runs the extension for Visual Studio Code with stand-ins for the editor and the client, and prints what it did as JSON.
// The client answers each request with the edit that is the first argument; the rest is what is typed before the cursor.

const Module = require("module");
const path = require("path");

const [extension, edit, typed, settings] = process.argv.slice(2);
const did = { snippets: [], commands: {}, requests: [], browsers: [], messages: [], options: undefined };
const listeners = { change: [], configuration: [] };

class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
  translate(lines, characters) {
    return new Position(this.line + lines, this.character + characters);
  }
}
class SnippetString {
  constructor() {
    this.value = "";
  }
  appendTabstop(number) {
    this.value += `$${number}`;
  }
  appendText(text) {
    this.value += text.replace(/[$}\\]/g, "\\$&");
  }
}
const values = { command: [process.execPath, "-e", process.env.VIEW ?? "", "lsp"], codeLens: true, checkWorkspace: true, autoCloseTags: true, ...JSON.parse(settings ?? "{}") };
const uri = { scheme: "file", toString: () => "file:///r.urdf" };
const document = { uri, languageId: "urdf", version: 1, fileName: "/r.urdf" };
const editor = { document, insertSnippet: async (snippet, range) => did.snippets.push([snippet.value, range]) };
const vscode = {
  Position,
  SnippetString,
  Uri: { parse: (text) => text },
  commands: {
    registerCommand: (name, call) => ((did.commands[name] = call), { dispose() {} }),
    executeCommand: async (name, ...given) => did.browsers.push([name, ...given]),
  },
  extensions: { getExtension: () => undefined },
  window: { activeTextEditor: editor, showErrorMessage: (text) => did.messages.push(text), showInformationMessage: (text) => did.messages.push(text) },
  workspace: {
    getConfiguration: () => ({ get: (name) => values[name] }),
    onDidChangeTextDocument: (call) => (listeners.change.push(call), { dispose() {} }),
    onDidChangeConfiguration: () => ({ dispose() {} }),
    createFileSystemWatcher: (glob) => ({ glob }),
  },
};
class LanguageClient {
  constructor(_id, _server, options) {
    did.options = options;
    this.code2ProtocolConverter = { asUri: String, asPosition: ({ line, character }) => ({ line, character }) };
    this.protocol2CodeConverter = { asRange: (range) => range };
  }
  async start() {}
  async stop() {}
  isRunning() {
    return true;
  }
  async sendRequest(method, params) {
    did.requests.push([method, params.position, params.ch]);
    return JSON.parse(edit);
  }
}
const load = Module._load;
Module._load = (name, ...rest) =>
  name === "vscode" ? vscode : name === "vscode-languageclient/node" ? { LanguageClient } : load(name, ...rest);

async function run() {
  const { activate } = require(path.resolve(extension));
  const context = { subscriptions: [] };
  await activate(context);
  const start = new Position(2, 10);
  const change = { text: typed, rangeLength: 0, range: { start } };
  for (const listener of listeners.change) listener({ document, contentChanges: [change], reason: undefined });
  await new Promise((done) => setTimeout(done, 50));
  if (process.env.VIEW) {
    did.commands["twinform.preview"]();
    const end = Date.now() + 20000;
    while (!did.browsers.length && !did.messages.length && Date.now() < end) await new Promise((done) => setTimeout(done, 20));
  }
  for (const each of context.subscriptions) each.dispose();
  console.log(JSON.stringify({ ...did, commands: Object.keys(did.commands) }));
}

run();
