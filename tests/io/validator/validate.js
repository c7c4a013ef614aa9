// Runs the Khronos glTF validator over files and folders: node validate.js MODULE_FOLDER PATH...
// Exit status 0: no errors; 1: at least one error (printed); 77: the validator is not installed (CTest skips).
'use strict';
const fs = require('fs');
const path = require('path');

const [moduleFolder, ...roots] = process.argv.slice(2);

let validator;
try {
    validator = require(path.join(path.resolve(moduleFolder), 'node_modules', 'gltf-validator'));
} catch (error) {
    console.log(`gltf-validator is not installed in ${moduleFolder}: ` +
                'run "npm install" there with tests/io/validator/package.json');
    process.exit(77);
}

function sceneFiles(root) {
    if (!fs.statSync(root).isDirectory()) {
        return [root];
    }
    return fs.readdirSync(root).sort().flatMap((name) => {
        const full = path.join(root, name);
        return fs.statSync(full).isDirectory() || /\.(gltf|glb|atrium)$/.test(name) ? sceneFiles(full) : [];
    });
}

async function errorsOf(file) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: path.basename(file),
        format: file.endsWith('.gltf') ? 'gltf' : 'glb',
        maxIssues: 1000,
        externalResourceFunction: (uri) =>
            fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri))).then((data) => new Uint8Array(data)),
    });
    return report.issues.messages.filter((message) => message.severity <= (process.env.WARNINGS ? 1 : 0));
}

(async () => {
    const files = roots.flatMap(sceneFiles);
    if (files.length === 0) {
        console.log('no scene files to validate');
        process.exit(1);
    }
    let failed = 0;
    for (const file of files) {
        const errors = await errorsOf(file);
        failed += errors.length > 0 ? 1 : 0;
        for (const error of errors.slice(0, 20)) {
            console.log(`${file}: ${error.code} at ${error.pointer}: ${error.message}`);
        }
    }
    console.log(`${files.length} files, ${failed} with errors`);
    process.exit(failed > 0 ? 1 : 0);
})().catch((error) => {
    console.error(error);
    process.exit(1);
});
