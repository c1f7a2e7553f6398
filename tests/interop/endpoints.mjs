// A second OPC UA client that nobody of this project wrote: node-opcua. Prints the endpoints of a server as one line
// of JSON: node endpoints.mjs opc.tcp://HOST:PORT. Without an address it only looks whether node-opcua is there.
// The exit code is that of node_opcua.mjs where node-opcua is missing.

import { opcua } from "./node_opcua.mjs";

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
