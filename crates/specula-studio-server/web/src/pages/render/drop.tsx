/** Files of a scene that are dropped on the page, or chosen: sent to the program, which opens the scene. */

import { useEffect, useId, useState } from 'preact/hooks';
import { upload } from '../../core/server';
import { Message, Progress } from '../../ui/controls';

interface Named {
  path: string;
  file: File;
}

/** Files below a dropped folder, with their paths. */
async function filesBelow(entry: FileSystemEntry): Promise<Named[]> {
  const path = entry.fullPath.replace(/^\//, '');
  if (entry.isFile) return [{ path, file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)) }];
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: Named[] = [];
  for (;;) {
    // A reader gives some entries at a time, and none at the end.
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return found;
    for (const below of some) found.push(...(await filesBelow(below)));
  }
}

async function filesOf(data: DataTransfer): Promise<Named[]> {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry?.()).filter((entry) => entry !== null && entry !== undefined);
  if (entries.length > 0) return (await Promise.all(entries.map(filesBelow))).flat();
  return [...data.files].map((file) => ({ path: file.name, file }));
}

/** The body of `POST /api/drop`: the length of the list, the list, the files. */
export function bodyOf(files: Named[], scene: string | undefined): Blob {
  const list = { files: files.map(({ path, file }) => ({ path, bytes: file.size })), ...(scene === undefined ? {} : { scene }) };
  const head = new TextEncoder().encode(JSON.stringify(list));
  const length = new DataView(new ArrayBuffer(4));
  length.setUint32(0, head.length, true);
  return new Blob([length.buffer, head, ...files.map(({ file }) => file)]);
}

const size = (bytes: number) => (bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** `onScene` gets the name of the scene that was opened. */
export function Drop({ onScene }: { onScene: (name: string) => void }) {
  const id = useId();
  const [isOver, setOver] = useState(false);
  const [sending, setSending] = useState<string>();
  const [problem, setProblem] = useState<string>();
  const [several, setSeveral] = useState<Named[]>([]);
  const send = async (files: Named[], scene?: string) => {
    if (files.length === 0) return;
    setProblem(undefined);
    setSeveral([]);
    setSending(`Reading ${files.length === 1 ? (files[0] as Named).path : `${files.length} files`} (${size(files.reduce((sum, { file }) => sum + file.size, 0))})`);
    try {
      const { name } = await upload<{ name: string }>('/api/drop', bodyOf(files, scene));
      onScene(name);
    } catch (error) {
      setProblem((error as Error).message);
      // A person can say which scene is meant.
      if (scene === undefined) setSeveral(files);
    }
    setSending(undefined);
  };
  useEffect(() => {
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') === true;
    const over = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      setOver(true);
    };
    const leave = (event: DragEvent) => {
      if (event.relatedTarget === null) setOver(false);
    };
    const drop = (event: DragEvent) => {
      if (!hasFiles(event) || event.dataTransfer === null) return;
      event.preventDefault();
      setOver(false);
      filesOf(event.dataTransfer).then(send, (error: Error) => setProblem(error.message));
    };
    addEventListener('dragover', over);
    addEventListener('dragleave', leave);
    addEventListener('drop', drop);
    return () => {
      removeEventListener('dragover', over);
      removeEventListener('dragleave', leave);
      removeEventListener('drop', drop);
    };
  }, []);
  const scenes = several.filter(({ path }) => /\.(pbrt|xml|gltf|glb|obj|ply)(\.gz)?$/i.test(path));
  return (
    <div class={isOver ? 'drop is-over' : 'drop'}>
      <label for={id}>Drop a scene with its files here, or choose them</label>
      <input id={id} type="file" multiple onChange={(event) => void send([...(event.currentTarget.files ?? [])].map((file) => ({ path: file.name, file })))} />
      {sending !== undefined && <Progress label={sending} />}
      <Message text={problem} />
      {scenes.length > 1 && (
        <div class="actions">
          {scenes.slice(0, 12).map(({ path }) => (
            <button key={path} type="button" onClick={() => void send(several, path)}>
              {path}
            </button>
          ))}
        </div>
      )}
    </div>
  );
}
