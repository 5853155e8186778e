// The site's data: scripts that hand text over, because a page opened by a double click may read no other files.

const waiting = new Map();  // name: what to do with the part

// Called by each script of data.
window.parvis_part = (name, content) => {
  const take = waiting.get(name);
  waiting.delete(name);
  if (take) take(content);
};

function load(name) {
  return new Promise((resolve, reject) => {
    waiting.set(name, resolve);
    const script = document.createElement('script');
    script.src = `${name}.js`;
    script.onerror = () => reject(new Error(`${name}.js is missing: the whole folder of the site is needed`));
    document.head.append(script);
    script.onload = () => {
      script.remove();
      if (waiting.has(name)) reject(new Error(`${name}.js is damaged`));
    };
  });
}

// The JSON of a part.
export const loadJson = name => load(name);

// The bytes of a part: base 64 of what is deflated.
export async function loadBytes(name) {
  const text = await load(name);
  const packed = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const inflated = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate')));
  return inflated.arrayBuffer();
}
