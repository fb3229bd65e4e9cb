// Stands for VS Code: opens a script, asks every provider of the extension, and prints the answers as one JSON object.
// node fake_editor.js SCRIPT PROGRAM EXTENSION
const Module = require("module");
const path = require("path");
const { readFileSync } = require("fs");

const [script, program, extension] = process.argv.slice(2);
const providers = {};
const handlers = {};
const published = new Map();
const answers = {};

class Uri {
  constructor(text) {
    this.text = text;
  }
  toString() {
    return this.text;
  }
  toJSON() {
    return path.basename(this.text);
  }
  get fsPath() {
    return decodeURIComponent(this.text.replace("file://", ""));
  }
  static parse(text) {
    return new Uri(text);
  }
  static file(name) {
    return new Uri(`file://${name}`);
  }
}
class Position {
  constructor(line, character) {
    Object.assign(this, { line, character });
  }
}
class Range {
  constructor(start, end) {
    Object.assign(this, { start, end });
  }
  toJSON() {
    return [this.start, this.end]; // as VS Code's does
  }
}
class WorkspaceEdit {
  set(uri, edits) {
    this[path.basename(uri.toString())] = edits;
  }
}
class Value {
  constructor(...given) {
    this.given = given;
  }
}

const on = (name) => (handler) => {
  handlers[name] = handler;
};
const register = (name) => (language, provider) => {
  providers[name] = provider;
};
const uri = Uri.file(script);
const text = { uri, languageId: "armal", version: 1, isDirty: false, getText: () => readFileSync(script, "utf8") };
const watcher = { onDidCreate: on("created"), onDidChange: on("changed"), onDidDelete: on("deleted") };
const values = [
  "Location", "TextEdit", "MarkdownString", "Diagnostic", "DiagnosticRelatedInformation", "DocumentSymbol",
  "CompletionItem", "SnippetString", "CodeLens", "CodeAction", "Hover", "Task", "ShellExecution",
];
const kinds = [
  "Hover", "CompletionItem", "Definition", "Reference", "Rename", "DocumentFormattingEdit", "DocumentSymbol",
  "CodeLens", "CodeActions",
];
const vscode = {
  ...Object.fromEntries(values.map((name) => [name, class extends Value {}])),
  Uri, Position, Range, WorkspaceEdit,
  TaskScope: { Workspace: 2 },
  CodeActionKind: { QuickFix: "quickfix" },
  languages: {
    createDiagnosticCollection: () => ({ set: (of, found) => published.set(of.toString(), found), delete: () => {} }),
    ...Object.fromEntries(kinds.map((name) => [`register${name}Provider`, register(name)])),
  },
  workspace: {
    textDocuments: [text],
    workspaceFolders: [{ uri: Uri.file(path.dirname(script)) }],
    getConfiguration: () => ({ get: () => program }),
    getWorkspaceFolder: () => undefined,
    createFileSystemWatcher: () => watcher,
    onDidOpenTextDocument: on("opened"),
    onDidChangeTextDocument: on("typed"),
    onDidCloseTextDocument: on("closed"),
  },
  commands: { registerCommand: on("command"), executeCommand: () => {} },
  tasks: { executeTask: (task) => (answers.task = task.given.at(-1).given) },
  window: { showErrorMessage: (message) => (answers.error = message) },
};
vscode.commands.registerCommand = (name, handler) => {
  handlers[name] = handler;
};
const load = Module._load;
Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));

async function ask() {
  const { activate, deactivate } = require(extension);
  await activate({ subscriptions: [] });
  if (answers.error) return;
  const at = new Position(3, 17);
  const place = new Range(new Position(3, 16), new Position(3, 20));
  answers.hover = await providers.Hover.provideHover(text, at);
  answers.completion = await providers.CompletionItem.provideCompletionItems(text, at);
  answers.definition = await providers.Definition.provideDefinition(text, at);
  answers.references = await providers.Reference.provideReferences(text, at, { includeDeclaration: true });
  answers.renamable = await providers.Rename.prepareRename(text, at);
  answers.renamed = await providers.Rename.provideRenameEdits(text, at, "BORE");
  const options = { tabSize: 8, insertSpaces: true };
  answers.formatted = await providers.DocumentFormattingEdit.provideDocumentFormattingEdits(text, options);
  answers.symbols = await providers.DocumentSymbol.provideDocumentSymbols(text);
  const lenses = await providers.CodeLens.provideCodeLenses(text);
  answers.lenses = lenses.map((lens) => lens.given[1].title);
  const { command, arguments: given } = lenses.at(-1).given[1];
  await handlers[command](...given);
  await new Promise((resolve) => {
    published.set = (of, found) => resolve((answers.diagnostics = found));
    handlers.typed({ document: { ...text, version: 2 }, contentChanges: [{ range: place, text: "HOLLE" }] });
  });
  answers.fixes = await providers.CodeActions.provideCodeActions(text, place);
  await deactivate();
}

ask().then(
  () => process.stdout.write(JSON.stringify(answers), () => process.exit(0)),
  (error) => {
    console.error(error);
    process.exit(1);
  },
);
