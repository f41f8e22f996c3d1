// Check the page's scripts against `parts.d.ts`, and that what Python tells them is read: `make lint` runs it with the
// folder of typescript. A key counts as read where a script reads it from a value of its type, or a key of that name
// from a value whose type nobody says.
const path = require('node:path');
const ts = require(path.resolve(process.argv[2], 'node_modules/typescript'));

const root = path.join(__dirname, '../..');
const config = ts.readConfigFile(path.join(root, 'tsconfig.json'), ts.sys.readFile);
const {fileNames, options} = ts.parseJsonConfigFileContent(config.config, ts.sys, root);
const program = ts.createProgram(fileNames, options), checker = program.getTypeChecker();
const isScript = file => file.fileName.endsWith('.js') && !file.fileName.includes('node_modules');
const isParts = file => path.basename(file.fileName) === 'parts.d.ts';

const read = new Set(), named = new Set();
function note(type, name) {
  const places = (type.isUnion() ? type.types : [type]).flatMap(one => checker.getPropertyOfType(checker.getNonNullableType(one), name)?.declarations ?? []);
  for (const place of places) read.add(place);
  if (!places.some(place => isParts(place.getSourceFile()))) named.add(name);
}
function written(node) {
  const {parent} = node;
  return ts.isBinaryExpression(parent) && parent.left === node && parent.operatorToken.kind === ts.SyntaxKind.EqualsToken;
}
function visit(node, words) {
  const typeOf = one => checker.getTypeAtLocation(one);
  if (ts.isPropertyAccessExpression(node) && !written(node)) note(typeOf(node.expression), node.name.text);
  if (ts.isElementAccessExpression(node)) {
    // By a name that runs through some: each word of the file that is a key counts.
    const of = typeOf(node.expression), {argumentExpression: by} = node;
    for (const word of ts.isStringLiteralLike(by) ? [by.text] : words) if (checker.getPropertyOfType(of, word)) note(of, word);
  }
  if (ts.isObjectBindingPattern(node))
    for (const one of node.elements) {
      const name = one.propertyName ?? one.name;
      if (!one.dotDotDotToken && ts.isIdentifier(name)) note(typeOf(node), name.text);
    }
  // A part as a whole is what these functions are given.
  if (ts.isCallExpression(node) && ts.isPropertyAccessExpression(node.expression) && ['paint', 'also'].includes(node.expression.name.text))
    for (const one of node.arguments) if (ts.isStringLiteralLike(one)) named.add(one.text);
  ts.forEachChild(node, one => visit(one, words));
}
function wordsOf(file) {
  const words = new Set(), look = node => { if (ts.isStringLiteralLike(node)) words.add(node.text); ts.forEachChild(node, look); };
  look(file);
  return words;
}
for (const file of program.getSourceFiles()) if (isScript(file)) visit(file, wordsOf(file));

const unread = [];
for (const file of program.getSourceFiles())
  if (isParts(file))
    for (const one of file.statements)
      if (ts.isInterfaceDeclaration(one) && one.name.text !== 'RxPresses')
        for (const key of one.members)
          if (!read.has(key) && !named.has(key.name.text)) unread.push(`no script reads ${one.name.text}.${key.name.text}`);
const faults = ts.getPreEmitDiagnostics(program).map(one => {
  const place = one.file ? `${path.relative(root, one.file.fileName)}:${one.file.getLineAndCharacterOfPosition(one.start).line + 1}: ` : '';
  return place + ts.flattenDiagnosticMessageText(one.messageText, ' ');
});
for (const line of [...faults, ...unread]) console.log(line);
process.exit(faults.length || unread.length ? 1 : 0);
