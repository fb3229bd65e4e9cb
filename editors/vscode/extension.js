// Starts `handeye lsp` and connects the editor to it; everything else is the server's.
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

async function activate(context) {
  const command = vscode.workspace.getConfiguration("handeye").get("command", "handeye");
  const files = vscode.workspace.createFileSystemWatcher("**/*.{al,toml}");
  context.subscriptions.push(files);
  client = new LanguageClient(
    "handeye",
    "Arm language",
    { command, args: ["lsp"] },
    {
      documentSelector: [{ language: "armal" }],
      synchronize: { fileEvents: files },
    },
  );
  try {
    await client.start();
  } catch (error) {
    vscode.window.showErrorMessage(
      `The arm language server did not start (${command} lsp): ${error.message}. ` +
        "Install handeye with `pip install .` in its folder, or set handeye.command",
    );
  }
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
