// Starts `twinform lsp` for URDF, SDF, MJCF and xacro files: all that the extension knows is in that server.

const { commands, extensions, Position, Uri, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { tagCloser } = require("./close_tags");
const { preview, stopPreview } = require("./preview");

const LANGUAGES = ["urdf", "sdf", "mjcf", "xacro"];

const STARTED_WITH = ["twinform.command", "twinform.codeLens", "twinform.checkWorkspace"];

let client;

function option(name) {
  return workspace.getConfiguration("twinform").get(name);
}

async function start() {
  const [command, ...args] = option("command");
  client = new LanguageClient(
    "twinform",
    { command, args },
    {
      initializationOptions: { codeLens: option("codeLens"), checkWorkspace: option("checkWorkspace") },
      documentSelector: [
        ...LANGUAGES.flatMap((language) => [{ scheme: "file", language }, { scheme: "untitled", language }]),
        // what names joints and links; the server leaves other YAML alone
        { scheme: "file", language: "yaml" },
        { scheme: "file", pattern: "**/*.srdf" },
      ],
      synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.{urdf,sdf,world,mjcf,xml,xacro}") },
      // close_tags.js asks for them
      middleware: { provideOnTypeFormattingEdits: () => [] },
    },
  );
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    window.showErrorMessage(
      `twinform: "${command}" cannot be started (${error.message}). Run: pip install "twinform[lsp]", ` +
        "or name the command in the setting twinform.command.",
    );
  }
}

async function stop() {
  const running = client;
  client = undefined;
  await running?.stop();
}

async function restart() {
  await stop();
  await start();
}

// What a lens above a name runs.
async function showReferences(uri, { line, character }) {
  await commands.executeCommand("editor.action.findReferences", Uri.parse(uri), new Position(line, character));
}

async function activate(context) {
  context.subscriptions.push(
    commands.registerCommand("twinform.restart", restart),
    commands.registerCommand("twinform.showReferences", showReferences),
    commands.registerCommand("twinform.preview", () => preview(option("command"))),
    { dispose: stopPreview },
    tagCloser(LANGUAGES, () => client),
    workspace.onDidChangeConfiguration((change) => STARTED_WITH.some((name) => change.affectsConfiguration(name)) && restart()),
  );
  // LemMinX takes our languages as well, but wakes up for XML only.
  extensions.getExtension("redhat.vscode-xml")?.activate();
  await start();
}

module.exports = { activate, deactivate: stop };
