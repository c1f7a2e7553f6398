// node-opcua, found or not; shared by the peers that use it.
//
// Exit code 3: node-opcua-client is missing. OPCUA_INTEROP_NODE_MODULES says which node_modules folder holds it.

import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

// node-opcua makes its own key and certificate lists below the user's configuration folder: give it another one.
export const folder = mkdtempSync(join(tmpdir(), "node-opcua-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
process.env.HOME = process.env.XDG_CONFIG_HOME = process.env.XDG_DATA_HOME = folder;

const modules = process.env.OPCUA_INTEROP_NODE_MODULES;
const require = createRequire(modules ? join(resolve(modules), "..", "anchor.js") : import.meta.url);

export function load(name) {
  try {
    return require(name);
  } catch (missing) {
    console.error(missing.message);
    process.exit(3);
  }
}

export const opcua = load("node-opcua-client");
// Comes with it.
export const { OPCUACertificateManager } = load("node-opcua-certificate-manager");
