// Shows the model of a file in 3D beside it: `twinform view --watch`, which draws it again whenever a file is saved.

const { spawn } = require("child_process");
const { commands, window } = require("vscode");

const ADDRESS = /https?:\/\/[\w.:-]+(?:\/[\w./-]*)?/;

let running;

function stopPreview() {
  running?.kill();
  running = undefined;
}

// `command` is that of the language server, whose last word gives way to `view`.
function preview(command) {
  const document = window.activeTextEditor?.document;
  if (document?.uri.scheme !== "file") {
    window.showInformationMessage("twinform: open the file of a model first, and save it.");
    return;
  }
  stopPreview();
  const [program, ...args] = command.slice(0, -1);
  const view = spawn(program, [...args, "view", "--watch", "--no-open", document.fileName]);
  running = view;
  let said = "";
  let isShown = false;
  const listen = (data) => {
    said += data;
    const address = ADDRESS.exec(said);
    if (address && !isShown) {
      isShown = true;
      commands.executeCommand("simpleBrowser.show", address[0]);
    }
  };
  view.stdout.on("data", listen);
  view.stderr.on("data", listen);
  view.on("error", (error) => window.showErrorMessage(`twinform: "${program}" cannot be started (${error.message}).`));
  view.on("exit", (code) => code && view === running && window.showErrorMessage(`twinform view: ${said.slice(-500)}`));
}

module.exports = { preview, stopPreview };
