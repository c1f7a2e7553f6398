// node-opcua reads the whole address space of a server into a file, in the form that walk.py describes.
// Arguments: the server's URL and the file.

import { createWriteStream } from "node:fs";
import { join } from "node:path";
import { once } from "node:events";

import { OPCUACertificateManager, folder, opcua } from "./node_opcua.mjs";

console.log = console.warn = console.info = console.error;

const BATCH = 200;
const { AttributeIds, BrowseDirection, DataType, NodeClass } = opcua;
const ATTRIBUTES = ["NodeClass", "BrowseName", "DataType", "ValueRank", "Value"].map((name) => AttributeIds[name]);

const [url, output] = process.argv.slice(2);
const manager = new OPCUACertificateManager({
  rootFolder: join(folder, "pki"),
  automaticallyAcceptUnknownCertificate: true,
});
await manager.initialize();
const client = opcua.OPCUAClient.create({
  clientCertificateManager: manager,
  endpointMustExist: false,
  connectionStrategy: { maxRetry: 0 },
});

// Every reference of each node.
async function references(session, nodes) {
  const requests = nodes.map((nodeId) => ({
    nodeId,
    browseDirection: BrowseDirection.Both,
    includeSubtypes: true,
    referenceTypeId: null,
    resultMask: 63,
  }));
  const found = [];
  for (let result of await session.browse(requests)) {
    const ofNode = [...(result.references ?? [])];
    while (result.continuationPoint?.length) {
      result = await session.browseNext(result.continuationPoint, false);
      ofNode.push(...(result.references ?? []));
    }
    found.push(ofNode);
  }
  return found;
}

function description(node, [kind, name, dataType, rank, value]) {
  if (!kind.statusCode.isGood()) {
    return { id: node, error: kind.statusCode.name };
  }
  const told = { id: node, class: NodeClass[kind.value.value] };
  told.name = `${name.value.value.namespaceIndex}:${name.value.value.name}`;
  if (dataType.statusCode.isGood()) {
    told.data_type = text(dataType.value.value);
    told.rank = rank.value.value;
  }
  if (told.class === "Variable") {
    told.value = value.statusCode.isGood() ? DataType[value.value.dataType] : value.statusCode.name;
  }
  return told;
}

// As the other walker writes it: without the namespace 0.
const text = (id) => id.toString().replace(/^ns=0;/, "");

await client.connect(url);
const session = await client.createSession();
const known = new Set(["i=84"]);
let waiting = [...known];
const file = createWriteStream(output);
while (waiting.length) {
  const batch = waiting.slice(0, BATCH);
  waiting = waiting.slice(BATCH);
  const found = await references(session, batch);
  const reads = batch.flatMap((nodeId) => ATTRIBUTES.map((attributeId) => ({ nodeId, attributeId })));
  const values = await session.read(reads);
  batch.forEach((node, at) => {
    const told = description(node, values.slice(at * ATTRIBUTES.length, (at + 1) * ATTRIBUTES.length));
    told.references = found[at].map((r) => [text(r.referenceTypeId), r.isForward, text(r.nodeId)]);
    file.write(`${JSON.stringify(told)}\n`);
    for (const other of told.references.flatMap(([type, , id]) => [type, id])) {
      if (!known.has(other)) {
        known.add(other);
        waiting.push(other);
      }
    }
  });
}
file.end();
await once(file, "finish");
await session.close();
await client.disconnect();
process.stdout.write(`${JSON.stringify({ ok: true, nodes: known.size })}\n`);
process.exit(0);
