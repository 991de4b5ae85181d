// Builds the pages into dist/: index.html, studio.js, studio.css, licences.txt.
//
//   node build.mjs                 writes dist/
//   node build.mjs --check         compares with dist/, writes nothing
//   node build.mjs --out DIR       writes there, with readable names and a source map
import { build } from 'esbuild';
import { mkdir, readFile, readdir, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const argument = (name) => {
  const at = process.argv.indexOf(name);
  return at < 0 ? undefined : process.argv[at + 1];
};
const isCheck = process.argv.includes('--check');
const out = argument('--out') ?? join(here, 'dist');
const isForUse = argument('--out') === undefined;

const common = {
  bundle: true,
  format: 'iife',
  target: 'es2022',
  jsx: 'automatic',
  jsxImportSource: 'preact',
  legalComments: 'none',
  minify: isForUse,
  charset: 'utf8',
  absWorkingDir: here,
  loader: { '.wgsl': 'text' },
  logLevel: 'warning',
  write: false,
};

/** `import text from 'worker:./file.ts'`: a classic worker's bundled text, since pages from disk load no files. */
const workers = {
  name: 'workers',
  setup(plugin) {
    plugin.onResolve({ filter: /^worker:/ }, ({ path, resolveDir }) => ({
      path: join(resolveDir, path.slice('worker:'.length)),
      namespace: 'worker',
    }));
    plugin.onLoad({ filter: /.*/, namespace: 'worker' }, async ({ path }) => {
      const result = await build({ ...common, entryPoints: [path] });
      return { contents: result.outputFiles[0].text, loader: 'text' };
    });
  },
};

async function bundle(entry, extra = {}) {
  const result = await build({ ...common, entryPoints: [entry], plugins: [workers], metafile: true, ...extra });
  return { text: result.outputFiles[0].text, inputs: Object.keys(result.metafile.inputs) };
}

/** The licences of what is bundled. */
async function licences(inputs) {
  const names = new Set();
  for (const input of inputs) {
    const found = /^node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(input);
    if (found) names.add(found[1]);
  }
  const parts = [];
  for (const name of [...names].sort()) {
    const folder = join(here, 'node_modules', name);
    const { version, license } = JSON.parse(await readFile(join(folder, 'package.json'), 'utf8'));
    const file = (await readdir(folder)).find((f) => /^licen[cs]e/i.test(f));
    const text = file ? (await readFile(join(folder, file), 'utf8')).trim() : license;
    parts.push(`${name} ${version}: ${license}\n\n${text.replace(/\r/g, '').replace(/[ \t]+$/gm, '')}\n`);
  }
  return parts.join(`\n${'-'.repeat(80)}\n\n`);
}

const script = await bundle('src/main.tsx', isForUse ? {} : { sourcemap: 'inline' });
const style = await bundle('src/studio.css');
const files = {
  'index.html': await readFile(join(here, 'src/index.html'), 'utf8'),
  'studio.js': script.text,
  'studio.css': style.text,
  'licences.txt': await licences(script.inputs),
};

let differing = 0;
if (!isCheck) await mkdir(out, { recursive: true });
for (const [name, text] of Object.entries(files)) {
  const path = join(out, name);
  if (isCheck) {
    const committed = await readFile(path, 'utf8').catch(() => '');
    if (committed !== text) {
      console.error(`${path} is not what the sources give: run npm run build`);
      differing += 1;
    }
  } else {
    await writeFile(path, text);
  }
}
if (differing > 0) process.exit(1);
