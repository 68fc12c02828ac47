// Starts the language server, `vpl lsp`, for VPL files. All that it knows comes from there.

const { commands, window, workspace } = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

/** The running client, if it runs. */
let client;

async function activate(context) {
  context.subscriptions.push(
    commands.registerCommand('vpl.restart', restart),
    workspace.onDidChangeConfiguration((change) => change.affectsConfiguration('vpl.path') && restart()),
  );
  await start();
}

async function deactivate() {
  const running = client;
  client = undefined;
  if (running?.isRunning()) await running.stop();
}

async function restart() {
  await deactivate();
  await start();
}

async function start() {
  const command = workspace.getConfiguration('vpl').get('path', 'vpl');
  const options = {
    documentSelector: [{ language: 'vpl' }],
    synchronize: { fileEvents: workspace.createFileSystemWatcher('**/*.vpl') },
  };
  client = new LanguageClient('vpl', 'VPL', { command, args: ['lsp'] }, options);
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    await missing(command, error);
  }
}

/** Says what could not be started, and leads to the setting that says where it is. */
async function missing(command, error) {
  const settings = 'Open Settings';
  const message = `\`${command} lsp\` did not start: ${error.message}. Set \`vpl.path\` to the vpl program.`;
  if ((await window.showErrorMessage(message, settings)) === settings) {
    await commands.executeCommand('workbench.action.openSettings', 'vpl.path');
  }
}

module.exports = { activate, deactivate };
