// node-opcua as a client that is judged. Takes orders from standard input, one line of JSON each, until its end:
// {"order": "attempt", "name": …}. Prints one line of JSON for each thing that happens, with the name of the order.

import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";

import { OPCUACertificateManager, folder, opcua } from "./node_opcua.mjs";

const tell = (name, what) => process.stdout.write(`${JSON.stringify({ name, ...what })}\n`);
// Its warnings about certificates that are wrong on purpose go where they do not disturb the answers.
console.log = console.warn = console.info = console.error;

// What servers show is not judged here.
const manager = new OPCUACertificateManager({
  rootFolder: join(folder, "pki"),
  automaticallyAcceptUnknownCertificate: true,
});
await manager.initialize();

// A client with the certificate, key, issuers and application URI of an order, if it has them.
function clientOf(order) {
  const { certificate, chain, key } = order;
  const own = {};
  if (certificate) {
    own.certificateFile = join(folder, `${order.name}.pem`);
    own.privateKeyFile = key;
    writeFileSync(own.certificateFile, [certificate, ...chain].map((file) => readFileSync(file, "utf8")).join(""));
  }
  const client = opcua.OPCUAClient.create({
    ...own,
    applicationUri: order.uri,
    clientCertificateManager: manager,
    securityPolicy: opcua.SecurityPolicy[POLICIES[order.policy] ?? order.policy],
    securityMode: opcua.MessageSecurityMode[order.mode],
    endpointMustExist: false,
    connectionStrategy: { maxRetry: 0 },
    requestedSessionTimeout: 10_000,
  });
  // It would say what its certificate says, whatever it is told.
  client._getApplicationUri = () => order.uri;
  return client;
}

// A session that is closed again.
async function attempt(order) {
  const client = clientOf(order);
  try {
    await client.connect(order.url);
    const session = await client.createSession();
    const value = await session.read({ nodeId: "i=2259", attributeId: opcua.AttributeIds.Value });
    await session.close();
    tell(order.name, { ok: value.statusCode.isGood(), state: STATES[value.value.value] });
  } catch (refused) {
    // Of a server that hangs up with an error message, node-opcua tells that it did, and not the error.
    const error = /Bad[A-Z]\w+|rejected by server/.exec(refused.message)?.[0] ?? refused.message;
    tell(order.name, { ok: false, error, detail: refused.message });
  } finally {
    await client.disconnect();
  }
}

// A session that stays open until the server ends it.
async function hold(order) {
  const client = clientOf(order);
  await client.connect(order.url);
  await client.createSession();
  client.on("connection_lost", () => tell(order.name, { lost: true }));
  tell(order.name, { connected: true });
}

const POLICIES = { Aes128Sha256RsaOaep: "Aes128_Sha256_RsaOaep", Aes256Sha256RsaPss: "Aes256_Sha256_RsaPss" };
// ServerState, OPC 10000-5 §12.6.
const STATES = ["Running", "Failed", "NoConfiguration", "Suspended", "Shutdown", "Test", "CommunicationFault", "Unknown"];

for await (const line of createInterface({ input: process.stdin })) {
  const order = JSON.parse(line);
  await { attempt, hold }[order.order](order);
}
process.exit(0);
