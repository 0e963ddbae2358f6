// Writes end tags while somebody types. The server says which, as it tells every editor (textDocument/onTypeFormatting);
// Visual Studio Code asks for it only with a setting that formats as well, and leaves the cursor before what it writes.

const { SnippetString, window, workspace } = require("vscode");

async function closeTag(client, document, change) {
  const position = change.range.start.translate(0, change.text.length);
  const version = document.version;
  const edits = await client.sendRequest("textDocument/onTypeFormatting", {
    textDocument: { uri: client.code2ProtocolConverter.asUri(document.uri) },
    position: client.code2ProtocolConverter.asPosition(position),
    ch: change.text,
    options: { tabSize: 2, insertSpaces: true },
  });
  const editor = window.activeTextEditor;
  if (!edits?.length || editor?.document !== document || document.version !== version) return;
  const { newText, range } = edits[0];
  const snippet = new SnippetString();
  if (change.text === ">") snippet.appendTabstop(0);
  snippet.appendText(newText);
  await editor.insertSnippet(snippet, client.protocol2CodeConverter.asRange(range));
}

function isTyped(document, { contentChanges, reason }) {
  const [change] = contentChanges;
  const isOne = contentChanges.length === 1 && reason === undefined && change.rangeLength === 0;
  return isOne && [">", "/"].includes(change.text) && window.activeTextEditor?.document === document;
}

// Returns a listener that closes tags in documents of these languages; `running` returns the client, if there is one.
function tagCloser(languages, running) {
  return workspace.onDidChangeTextDocument((event) => {
    const { document, contentChanges } = event;
    const wanted = workspace.getConfiguration("twinform", document).get("autoCloseTags");
    if (!wanted || !languages.includes(document.languageId) || !isTyped(document, event)) return;
    // The client has to tell the server of the change first, and hears of it at the same time.
    setTimeout(() => running()?.isRunning() && closeTag(running(), document, contentChanges[0]), 0);
  });
}

module.exports = { tagCloser };
