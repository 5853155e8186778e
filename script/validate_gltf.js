// Prints the errors that the Khronos glTF validator finds; exit status 1 if there are any.
const fs = require('fs');
const path = require('path');
const validator = require('gltf-validator');

async function errorsOf(file) {
  const beside = uri => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))));
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)),
      {uri: path.basename(file), externalResourceFunction: uri => Promise.resolve().then(() => beside(uri))});
  for (const issue of report.issues.messages.filter(message => message.severity === 0))
    console.log(`${file}: ${issue.pointer}: ${issue.message}`);
  return report.issues.numErrors;
}

Promise.all(process.argv.slice(2).map(errorsOf)).then(counts => {
  const total = counts.reduce((sum, count) => sum + count, 0);
  console.log(`gltf_validator_errors ${total} in ${counts.length} files`);
  process.exitCode = total === 0 ? 0 : 1;
}, problem => {
  console.error(String(problem));
  process.exitCode = 1;
});
