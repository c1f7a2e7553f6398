// A second OPC UA client that nobody of this project wrote: node-opcua. Prints the endpoints of a server as one line
// of JSON: node endpoints.mjs opc.tcp://HOST:PORT. Without an address it only looks whether node-opcua is there.
// Exit code 3: node-opcua-client is missing. OPCUA_INTEROP_NODE_MODULES says which node_modules folder holds it.

import { mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

// node-opcua makes its own key and certificate lists below the user's configuration folder: give it another one.
const folder = mkdtempSync(join(tmpdir(), "node-opcua-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
process.env.HOME = process.env.XDG_CONFIG_HOME = process.env.XDG_DATA_HOME = folder;

const modules = process.env.OPCUA_INTEROP_NODE_MODULES;
const require = createRequire(modules ? join(resolve(modules), "..", "anchor.js") : import.meta.url);

let opcua;
try {
  opcua = require("node-opcua-client");
} catch (missing) {
  console.error(missing.message);
  process.exit(3);
}
if (process.argv.length < 3) {
  process.exit(0);
}

const client = opcua.OPCUAClient.create({
  endpointMustExist: false,
  connectionStrategy: { maxRetry: 0 },
  requestedSessionTimeout: 10_000,
});

let answer;
try {
  await client.connect(process.argv[2]);
  const endpoints = await client.getEndpoints();
  answer = {
    ok: true,
    application_uri: endpoints[0].server.applicationUri,
    endpoints: endpoints.map((endpoint) => ({
      url: endpoint.endpointUrl,
      policy: endpoint.securityPolicyUri.split("#").pop().replaceAll("_", ""),
      mode: opcua.MessageSecurityMode[endpoint.securityMode],
      tokens: [...new Set(endpoint.userIdentityTokens.map((token) => opcua.UserTokenType[token.tokenType]))].sort(),
    })),
  };
} catch (refused) {
  answer = { ok: false, error: refused.message };
} finally {
  await client.disconnect();
}
console.log(JSON.stringify(answer));
process.exit(0);
