// Validates the GLB files named on the command line; prints the counts of each and every error and warning.
// Exit code 1 where there is one.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

const severityNames = ['error', 'warning'];

async function validate(file) {
  const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
  console.log(`${path.basename(file)}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, `
    + `${issues.numInfos} infos, ${issues.numHints} hints`);
  for (const issue of issues.messages) {
    const severity = severityNames[issue.severity];
    if (severity) console.log(`  ${severity} ${issue.code} at ${issue.pointer ?? issue.offset}: ${issue.message}`);
  }
  return issues.numErrors + issues.numWarnings === 0;
}

async function main() {
  for (const file of process.argv.slice(2)) {
    if (!await validate(file)) process.exitCode = 1;
  }
}

main();
