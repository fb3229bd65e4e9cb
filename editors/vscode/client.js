// A client for the part of the Language Server Protocol that the server of the arm language uses. It needs no package.
const { spawn } = require("child_process");
const vscode = require("vscode");

const LANGUAGE = "armal";

// Messages of JSON-RPC over the server's standard input and output.
class Connection {
  constructor(command, args) {
    this.waiting = new Map();
    this.notices = new Map();
    this.number = 0;
    this.received = Buffer.alloc(0);
    this.process = spawn(command, args, { stdio: ["pipe", "pipe", "ignore"] });
    this.process.stdin.on("error", () => {}); // `ended` reports the reason
    this.process.stdout.on("data", (data) => this.read(data));
    this.ended = new Promise((resolve) => {
      this.process.on("error", (error) => resolve(error));
      this.process.on("exit", (code) => resolve(new Error(`it ended with code ${code}`)));
    });
    this.ended.then((error) => this.waiting.forEach(({ reject }) => reject(error)));
  }

  send(message) {
    const body = Buffer.from(JSON.stringify({ jsonrpc: "2.0", ...message }));
    this.process.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
    this.process.stdin.write(body);
  }

  notify(method, params) {
    this.send({ method, params });
  }

  request(method, params) {
    const id = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.send({ id, method, params });
    });
  }

  read(data) {
    this.received = Buffer.concat([this.received, data]);
    for (;;) {
      const end = this.received.indexOf("\r\n\r\n");
      if (end < 0) return;
      const length = Number(/Content-Length: (\d+)/i.exec(this.received.toString("ascii", 0, end))[1]);
      if (this.received.length < end + 4 + length) return;
      const body = this.received.toString("utf8", end + 4, end + 4 + length);
      this.received = this.received.subarray(end + 4 + length);
      this.take(JSON.parse(body));
    }
  }

  take(message) {
    if (message.method === undefined) {
      const { resolve, reject } = this.waiting.get(message.id) ?? {};
      this.waiting.delete(message.id);
      if (message.error) reject?.(new Error(message.error.message));
      else resolve?.(message.result);
    } else if (message.id === undefined) {
      this.notices.get(message.method)?.(message.params);
    } else {
      this.send({ id: message.id, result: null }); // a request of the server that this client cannot answer
    }
  }
}

// -- conversions between values of the protocol and of VS Code -------------------------------------------------------

const position = ({ line, character }) => new vscode.Position(line, character);
const range = ({ start, end }) => new vscode.Range(position(start), position(end));
const sent = ({ start, end }) => ({
  start: { line: start.line, character: start.character },
  end: { line: end.line, character: end.character },
}); // the Range of VS Code would become an array in JSON
const location = (found) => new vscode.Location(vscode.Uri.parse(found.uri), range(found.range));
const edits = (found) => (found ?? []).map((each) => new vscode.TextEdit(range(each.range), each.newText));
const words = (contents) =>
  new vscode.MarkdownString(typeof contents === "string" ? contents : (contents?.value ?? ""));

function workspaceEdit(found) {
  const edit = new vscode.WorkspaceEdit();
  for (const [uri, changes] of Object.entries(found?.changes ?? {})) edit.set(vscode.Uri.parse(uri), edits(changes));
  return edit;
}

function diagnostic(found) {
  const made = new vscode.Diagnostic(range(found.range), found.message, (found.severity ?? 1) - 1);
  made.code = found.codeDescription
    ? { value: found.code, target: vscode.Uri.parse(found.codeDescription.href) }
    : found.code;
  made.source = found.source;
  made.tags = found.tags;
  made.relatedInformation = (found.relatedInformation ?? []).map(
    (each) => new vscode.DiagnosticRelatedInformation(location(each.location), each.message),
  );
  return made;
}

function symbol(found) {
  const made = new vscode.DocumentSymbol(
    found.name,
    found.detail ?? "",
    found.kind - 1,
    range(found.range),
    range(found.selectionRange),
  );
  made.children = (found.children ?? []).map(symbol);
  return made;
}

function completion(found) {
  const made = new vscode.CompletionItem(found.label, (found.kind ?? 1) - 1);
  made.detail = found.detail;
  made.documentation = found.documentation && words(found.documentation);
  made.sortText = found.sortText;
  made.filterText = found.filterText;
  const text = found.textEdit?.newText ?? found.insertText;
  if (text !== undefined) made.insertText = found.insertTextFormat === 2 ? new vscode.SnippetString(text) : text;
  if (found.textEdit) made.range = range(found.textEdit.range ?? found.textEdit.replace);
  return made;
}

function lens(found) {
  return new vscode.CodeLens(range(found.range), found.command);
}

function action(found) {
  const made = new vscode.CodeAction(found.title, vscode.CodeActionKind.QuickFix);
  made.edit = workspaceEdit(found.edit);
  made.diagnostics = (found.diagnostics ?? []).map(diagnostic);
  made.isPreferred = found.isPreferred;
  return made;
}

// -- the client -------------------------------------------------------------------------------------------------------

async function start(command, args, subscriptions) {
  const server = new Connection(command, args);
  const shown = vscode.languages.createDiagnosticCollection("handeye");
  server.notices.set("textDocument/publishDiagnostics", ({ uri, diagnostics }) =>
    shown.set(vscode.Uri.parse(uri), diagnostics.map(diagnostic)),
  );
  const root = vscode.workspace.workspaceFolders?.[0]?.uri.toString() ?? null;
  await server.request("initialize", { processId: process.pid, rootUri: root, capabilities: {} });
  server.notify("initialized", {});

  const of = (text) => ({ uri: text.uri.toString() });
  const ours = (text) => text.languageId === LANGUAGE;
  const at = (text, place) => ({ textDocument: of(text), position: place });
  const opened = (text) => {
    const { languageId, version } = text;
    if (ours(text))
      server.notify("textDocument/didOpen", {
        textDocument: { ...of(text), languageId, version, text: text.getText() },
      });
  };
  vscode.workspace.textDocuments.forEach(opened);

  const files = vscode.workspace.createFileSystemWatcher("**/*.{al,toml}");
  const changed = (type) => (uri) =>
    server.notify("workspace/didChangeWatchedFiles", { changes: [{ uri: uri.toString(), type }] });
  const ask = (method, made, params) => async (text, ...more) => made(await server.request(method, params(text, ...more)));
  const each = (made) => (found) => (found ?? []).map(made);
  const { languages } = vscode;
  subscriptions.push(
    shown,
    files,
    files.onDidCreate(changed(1)),
    files.onDidChange(changed(2)),
    files.onDidDelete(changed(3)),
    vscode.workspace.onDidOpenTextDocument(opened),
    vscode.workspace.onDidChangeTextDocument(({ document, contentChanges }) => {
      if (!ours(document) || contentChanges.length === 0) return;
      server.notify("textDocument/didChange", {
        textDocument: { ...of(document), version: document.version },
        contentChanges: contentChanges.map((change) => ({ range: sent(change.range), text: change.text })),
      });
    }),
    vscode.workspace.onDidCloseTextDocument((text) => {
      if (!ours(text)) return;
      server.notify("textDocument/didClose", { textDocument: of(text) });
      shown.delete(text.uri);
    }),
    languages.registerHoverProvider(LANGUAGE, {
      provideHover: ask("textDocument/hover", (found) => found && new vscode.Hover(words(found.contents)), at),
    }),
    languages.registerCompletionItemProvider(
      LANGUAGE,
      { provideCompletionItems: ask("textDocument/completion", (found) => (found?.items ?? found ?? []).map(completion), at) },
      " ",
    ),
    languages.registerDefinitionProvider(LANGUAGE, {
      provideDefinition: ask("textDocument/definition", each(location), at),
    }),
    languages.registerReferenceProvider(LANGUAGE, {
      provideReferences: ask("textDocument/references", each(location), (text, place, context) => ({
        ...at(text, place),
        context,
      })),
    }),
    languages.registerRenameProvider(LANGUAGE, {
      prepareRename: ask("textDocument/prepareRename", range, at),
      provideRenameEdits: ask("textDocument/rename", workspaceEdit, (text, place, newName) => ({
        ...at(text, place),
        newName,
      })),
    }),
    languages.registerDocumentFormattingEditProvider(LANGUAGE, {
      provideDocumentFormattingEdits: ask("textDocument/formatting", edits, (text, { tabSize, insertSpaces }) => ({
        textDocument: of(text),
        options: { tabSize, insertSpaces },
      })),
    }),
    languages.registerDocumentSymbolProvider(LANGUAGE, {
      provideDocumentSymbols: ask("textDocument/documentSymbol", each(symbol), (text) => ({ textDocument: of(text) })),
    }),
    languages.registerCodeLensProvider(LANGUAGE, {
      provideCodeLenses: ask("textDocument/codeLens", each(lens), (text) => ({ textDocument: of(text) })),
    }),
    languages.registerCodeActionsProvider(LANGUAGE, {
      provideCodeActions: ask("textDocument/codeAction", each(action), (text, where) => ({
        textDocument: of(text),
        range: sent(where),
        context: { diagnostics: [] },
      })),
    }),
  );
  return async () => {
    await server.request("shutdown", null).catch(() => {});
    server.notify("exit", null);
  };
}

module.exports = { start };
