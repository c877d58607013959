/** Most bytes that are looked through for a skeleton: it stands at the begin of its file. */
const kHead = 1_000_000

/** The names of a motion file's joints where they can be read here, in the order of the file; empty where they cannot. */
export async function jointsOf(file: File, ending: string): Promise<readonly string[]> {
  try {
    if (ending === '.bvh') return bvhJoints(await file.slice(0, kHead).text())
    if (ending === '.gltf') return nodeNames(await file.text())
    if (ending === '.glb') return nodeNames(await glbText(file))
  } catch {
    // What is wrong with the file is told by the server, which reads it.
  }
  return []
}

export function bvhJoints(text: string): readonly string[] {
  const hierarchy = text.split(/^\s*MOTION\s*$/m, 1)[0]
  return [...hierarchy.matchAll(/^\s*(?:ROOT|JOINT)[ \t]+(.+?)\s*$/gm)].map(([, name]) => name)
}

function nodeNames(text: string): readonly string[] {
  const { nodes = [] } = JSON.parse(text) as { nodes?: { name?: string }[] }
  return [...new Set(nodes.flatMap(({ name }) => (name ? [name] : [])))]
}

/** The text of a GLB: its first part, whose length stands before it. */
async function glbText(file: File): Promise<string> {
  const length = new DataView(await file.slice(12, 16).arrayBuffer()).getUint32(0, true)
  return file.slice(20, 20 + length).text()
}
