// Starts `twinform lsp` for URDF, SDF and xacro files: all that the extension knows is in that server.

const { commands, extensions, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { tagCloser } = require("./close_tags");

const LANGUAGES = ["urdf", "sdf", "xacro"];

let client;

async function start() {
  const [command, ...args] = workspace.getConfiguration("twinform").get("command");
  client = new LanguageClient(
    "twinform",
    { command, args },
    {
      documentSelector: [
        ...LANGUAGES.flatMap((language) => [{ scheme: "file", language }, { scheme: "untitled", language }]),
        // what names joints and links; the server leaves other YAML alone
        { scheme: "file", language: "yaml" },
        { scheme: "file", pattern: "**/*.srdf" },
      ],
      // close_tags.js asks for them
      middleware: { provideOnTypeFormattingEdits: () => [] },
    },
  );
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    window.showErrorMessage(
      `twinform: "${command}" cannot be started (${error.message}). Run: pip install "twinform[lsp,xacro]", ` +
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

async function activate(context) {
  context.subscriptions.push(
    commands.registerCommand("twinform.restart", restart),
    tagCloser(LANGUAGES, () => client),
    workspace.onDidChangeConfiguration((change) => change.affectsConfiguration("twinform.command") && restart()),
  );
  // LemMinX takes our languages as well, but wakes up for XML only.
  extensions.getExtension("redhat.vscode-xml")?.activate();
  await start();
}

module.exports = { activate, deactivate: stop };
