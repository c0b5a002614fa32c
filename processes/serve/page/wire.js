// What the server sends: bundles of one frame (frame_view.hpp), JSON, events.

/** The frame of a bundle: its JSON with `image` and `mask` as ImageBitmap or null. */
export async function parseBundle(buffer) {
  const length = new DataView(buffer).getUint32(0);
  const frame = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const image_at = 4 + length;
  const mask_at = image_at + frame.image_bytes;
  const bitmap = async (at, bytes, type) => {
    if (bytes === 0) return null;
    const blob = new Blob([new Uint8Array(buffer, at, bytes)], {type});
    // As the detector sees it: an orientation that the file states is not applied, nor a colour profile.
    return createImageBitmap(blob, {imageOrientation: 'none', colorSpaceConversion: 'none'});
  };
  frame.image = await bitmap(image_at, frame.image_bytes, 'image/jpeg');
  frame.mask = await bitmap(mask_at, frame.mask_bytes, 'image/png');
  return frame;
}

/** null: nothing new. Throws an Error with the server's words. */
export async function fetchFrame(address) {
  const response = await fetch(address);
  if (response.status === 204) return null;
  if (!response.ok) throw new Error((await response.text()).trim());
  return parseBundle(await response.arrayBuffer());
}

/** `signal`: of an AbortController, where somebody may want it no longer. */
export async function fetchJson(address, signal) {
  const response = await fetch(address, {signal});
  if (!response.ok) throw new Error((await response.text()).trim());
  return response.json();
}

/** Does `work` again only when it has been done: a disk or a supervisor that does not answer must not take all of the few
    connections that a browser has for a server, which the live image needs. Whoever asks meanwhile, as after a write, gets `busy()`
    at once, and `work` is done once more: what is under way may have been answered before. */
export function unlessBusy(work, busy = () => {}) {
  let is_busy = false;
  let is_asked_again = false;
  return async () => {
    is_asked_again = is_busy;
    if (is_busy) return busy();
    is_busy = true;
    try {
      do {
        is_asked_again = false;
        await work();
      } while (is_asked_again);
    } finally {
      is_busy = false;
    }
  };
}

/** Returns the fault in words; '' where it was done. */
export async function write(address) {
  try {
    const response = await fetch(address, {method: 'POST', headers: {'X-Redbee': '1'}});
    return response.ok ? '' : (await response.text()).trim();
  } catch (error) {
    return 'no connection';
  }
}

/** Events of the server, again and again whatever ends the connection. `handlers`: by the event's name, and
    `connected(is_connected)`. */
export function listen(handlers) {
  const source = new EventSource('/api/events');
  source.onopen = () => handlers.connected(true);
  source.onerror = () => {
    handlers.connected(false);
    // A browser tries again by itself, but for a server that answers with a fault, as one that is just starting.
    if (source.readyState !== EventSource.CLOSED) return;
    setTimeout(() => listen(handlers), 1000);
  };
  for (const name of ['frame', 'health', 'map']) {
    source.addEventListener(name, (event) => handlers[name](JSON.parse(event.data)));
  }
}
