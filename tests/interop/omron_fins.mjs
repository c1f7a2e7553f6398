// omron-fins reads and writes a PLC; prints one line of JSON about it.
//
//     node omron_fins.mjs tcp|udp HOST PORT NODE
//
// Without arguments only loads the library; exit code 3: it is missing. OPCUA_INTEROP_NODE_MODULES says which
// node_modules folder holds it.

import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const modules = process.env.OPCUA_INTEROP_NODE_MODULES;
const require = createRequire(modules ? join(resolve(modules), "..", "anchor.js") : import.meta.url);

let fins;
try {
  fins = require("omron-fins");
} catch (missing) {
  console.error(missing.message);
  process.exit(3);
}

const [protocol, host, port, node] = process.argv.slice(2);
if (!protocol) process.exit(0);

const client = fins.FinsClient(Number(port), host, { protocol, timeout: 5000, SA1: 1, DA1: Number(node), MODE: "CS" });
const found = {};

const fail = (error) => {
  console.error(error);
  process.exit(1);
};

// Calls a command of the client and gives the response.
const call = (name, ...parameters) =>
  new Promise((resolve) => {
    client[name](...parameters, (error, message) => {
      if (error) fail(error);
      if (message.timeout) fail(`${name} timed out`);
      resolve(message.response);
    });
  });

async function check() {
  found.write = (await call("write", "D300", [321, 65535])).endCode;
  found.words = (await call("read", "D300", 2)).values;
  found.writeBits = (await call("write", "CIO0.14", [true, false])).endCode;
  found.bits = (await call("read", "CIO0.14", 2)).values;
  found.fill = (await call("fill", "W10", 43981, 3)).endCode;
  found.transfer = (await call("transfer", "W10", "E1_20", 3)).endCode;
  found.transferred = (await call("read", "E1_20", 3)).values;
  found.several = (await call("readMultiple", ["D300", "C5", "T3.x"])).values;
  found.readOnly = (await call("write", "A0", [1])).endCode;
  found.beyond = (await call("read", "W512", 1)).endCode;
  found.data = (await call("cpuUnitDataRead")).result;
  found.status = (await call("status")).result;
  found.clock = (await call("clockRead")).result;
  found.stop = (await call("stop")).endCode;
  found.stopped = (await call("status")).result.mode;
  found.run = (await call("run")).endCode;
  console.log(JSON.stringify(found));
  client.disconnect();
  process.exit(0);
}

client.on("error", fail);
// The client is connected when its handlers of "open" have returned.
client.on("open", () => setImmediate(() => check().catch(fail)));
