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
