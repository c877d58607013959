// validate.mjs FILE: checks an OpenAPI document: that it is one, that every operation has an id of its own, and that every
// schema in it can be compiled as JSON Schema 2020-12 with all references found.
import { readFileSync } from 'node:fs';
import { basename } from 'node:path';
import { Validator } from '@seriousme/openapi-schema-validator';
import Ajv2020 from 'ajv/dist/2020.js';

const file = process.argv[2];
const document = JSON.parse(readFileSync(file, 'utf8'));
const faults = [];

const result = await new Validator().validate(structuredClone(document));
if (!result.valid) {
  for (const fault of [].concat(result.errors)) {
    faults.push(typeof fault === 'string' ? fault : `${fault.instancePath}: ${fault.message}`);
  }
}

const ids = new Set();
let operations = 0;
for (const [path, item] of Object.entries(document.paths ?? {})) {
  for (const [method, operation] of Object.entries(item)) {
    operations += 1;
    if (ids.has(operation.operationId)) faults.push(`${method} ${path}: the id ${operation.operationId} is used twice`);
    ids.add(operation.operationId);
    const inPath = [...path.matchAll(/\{(\w+)\}/g)].map((match) => match[1]).sort().join();
    const declared = (operation.parameters ?? []).filter((p) => p.in === 'path').map((p) => p.name).sort().join();
    if (inPath !== declared) faults.push(`${method} ${path}: its parameters in the path are '${declared}'`);
  }
}

const ajv = new (Ajv2020.default ?? Ajv2020)({ strict: false, allErrors: true });
ajv.addSchema({ $id: 'document', ...document });
const compile = (schema, where) => {
  try {
    ajv.compile(JSON.parse(JSON.stringify(schema).replaceAll('"#/', '"document#/')));
  } catch (error) {
    faults.push(`${where}: ${error.message}`);
  }
};
for (const [name, schema] of Object.entries(document.components?.schemas ?? {})) compile(schema, `schema ${name}`);
for (const [path, item] of Object.entries(document.paths ?? {})) {
  for (const operation of Object.values(item)) {
    for (const parameter of operation.parameters ?? []) compile(parameter.schema, `${path}: ${parameter.name}`);
    const body = operation.requestBody?.content?.['application/json']?.schema;
    if (body) compile(body, `${path}: body`);
  }
}

for (const fault of faults) console.log(`${basename(file)}: ${fault}`);
console.log(`${basename(file)}: OpenAPI ${result.specification?.openapi ?? document.openapi}, ${operations} operations, ` +
  `${Object.keys(document.components?.schemas ?? {}).length} schemas, ${faults.length} faults`);
process.exit(faults.length === 0 && operations > 0 ? 0 : 1);
