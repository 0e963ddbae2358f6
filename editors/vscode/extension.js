// Starts `twinform lsp` for URDF, SDF and xacro files: all that the extension knows is in that server.

const { commands, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const LANGUAGES = ["urdf", "sdf", "xacro"];

let client;

async function start() {
  const [command, ...args] = workspace.getConfiguration("twinform").get("command");
  client = new LanguageClient(
    "twinform",
    { command, args },
    { documentSelector: LANGUAGES.flatMap((language) => [{ scheme: "file", language }, { scheme: "untitled", language }]) },
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
    workspace.onDidChangeConfiguration((change) => change.affectsConfiguration("twinform.command") && restart()),
  );
  await start();
}

module.exports = { activate, deactivate: stop };
