// node-opcua's server with as many nodes as asked for, for opcua_server.rs: FOLDER NODES VARIABLES.
//
// FOLDER holds own.crt and own.pem. Prints one line of JSON: the address, how many nodes there are, and VARIABLES nodes
// to be read. Runs until it is ended.

import { createServer } from "node:net";
import { join } from "node:path";

import { OPCUACertificateManager, folder, load, opcua } from "../interop/node_opcua.mjs";

const { OPCUAServer } = load("node-opcua-server");
const { DataType, MessageSecurityMode, SecurityPolicy } = opcua;
console.log = console.warn = console.info = console.error;

const [own, nodes, variables] = process.argv.slice(2);

// node-opcua needs to know its port before it listens.
async function freePort() {
  const probe = createServer();
  await new Promise((listening) => probe.listen(0, "127.0.0.1", listening));
  const { port } = probe.address();
  await new Promise((closed) => probe.close(closed));
  return port;
}

const manager = new OPCUACertificateManager({
  rootFolder: join(folder, "pki"),
  automaticallyAcceptUnknownCertificate: true,
});
await manager.initialize();
const port = await freePort();
const server = new OPCUAServer({
  port,
  host: "127.0.0.1",
  hostname: "127.0.0.1",
  certificateFile: join(own, "own.crt"),
  privateKeyFile: join(own, "own.pem"),
  serverCertificateManager: manager,
  serverInfo: { applicationUri: "urn:server" },
  securityPolicies: [SecurityPolicy.None, SecurityPolicy.Basic256Sha256],
  securityModes: [MessageSecurityMode.None, MessageSecurityMode.SignAndEncrypt],
  allowAnonymous: true,
  disableDiscovery: true,
});
await server.initialize();
const space = server.engine.addressSpace;
const namespace = space.getOwnNamespace();
const count = () => space.getNamespaceArray().reduce((sum, each) => sum + [...each.nodeIterator()].length, 0);
let missing = Number(nodes) - count();
let group;
let number = 0;
for (; missing > 0 || number < Number(variables); number += 1, missing -= 1) {
  if (number % 100 === 0) {
    group = namespace.addObject({ organizedBy: space.rootFolder.objects, browseName: `Group${number}` });
    missing -= 1;
  }
  const value = { dataType: DataType.Double, value: number * 0.5 };
  namespace.addVariable({
    componentOf: group,
    browseName: `Value${number}`,
    nodeId: `s=Value${number}`,
    dataType: DataType.Double,
    value,
  });
}
await server.start();
const told = {
  url: `opc.tcp://127.0.0.1:${port}/`,
  nodes: count(),
  variables: Array.from({ length: Number(variables) }, (_, at) => `ns=${namespace.index};s=Value${at}`),
};
process.stdout.write(`${JSON.stringify(told)}\n`);
