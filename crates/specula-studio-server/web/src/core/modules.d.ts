declare module 'worker:*' {
  const text: string;
  export default text;
}
declare module '*.wgsl' {
  const text: string;
  export default text;
}
declare module 'temml' {
  const temml: { renderToString(tex: string, options?: { displayMode?: boolean; throwOnError?: boolean }): string };
  export default temml;
}

// Constants of WebGPU that TypeScript's library lacks.
declare const GPUShaderStage: { COMPUTE: number };
declare const GPUBufferUsage: Record<'UNIFORM' | 'STORAGE' | 'COPY_SRC' | 'COPY_DST' | 'MAP_READ', number>;
declare const GPUMapMode: { READ: number };
