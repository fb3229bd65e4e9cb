// Connects the editor to `handeye lsp`, and runs `handeye run` in a terminal when a command above a stage is clicked.
const path = require("path");
const vscode = require("vscode");
const { start } = require("./client");

const COMMANDS = ["handeye.run", "handeye.runFromHere", "handeye.debug"];

let stop;

function program() {
  return vscode.workspace.getConfiguration("handeye").get("command", "handeye");
}

// Saves the script, and runs `handeye` with these arguments in the folder of the script. VS Code quotes the arguments
// for the shell.
async function carryOut(file, words) {
  const script = vscode.workspace.textDocuments.find((text) => text.uri.fsPath === file);
  if (script?.isDirty && !(await script.save())) return;
  const scope = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(file)) ?? vscode.TaskScope.Workspace;
  const typed = new vscode.ShellExecution(program(), words, { cwd: path.dirname(file) });
  await vscode.tasks.executeTask(new vscode.Task({ type: "shell" }, scope, path.basename(file), "handeye", typed));
}

async function activate(context) {
  const command = program();
  for (const name of COMMANDS) {
    context.subscriptions.push(vscode.commands.registerCommand(name, carryOut));
  }
  try {
    stop = await start(command, ["lsp"], context.subscriptions);
  } catch (error) {
    vscode.window.showErrorMessage(
      `The arm language server did not start (${command} lsp): ${error.message}. ` +
        "Install handeye with `pip install .` in its folder, or set handeye.command",
    );
  }
}

function deactivate() {
  return stop?.();
}

module.exports = { activate, deactivate };
