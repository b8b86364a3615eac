// A scan or photograph under the field, over which a mechanism is traced. It stays in the browser.

import { find, say } from "./talk.js";

const SVG = "http://www.w3.org/2000/svg";
const PART = 0.8; // part of the field that a picture fills at first
const file = find("picture-file");
let picture = null; // its element, upper left corner and size, in the unit of the scene

/** Two opposite corners of the picture; none without a picture. */
export const corners = () =>
  picture
    ? [
        [picture.x, picture.y],
        [picture.x + picture.width, picture.y - picture.height],
      ]
    : [];

/** The marks below the others in the field. */
export const under = () => (picture ? [picture.image] : []);

/** Call back when a picture is chosen or removed; `seen` returns the visible part of the field:
 * left and upper edge, width and height. */
export function onPicture(work, seen) {
  file.addEventListener("change", () => {
    if (file.files[0]) lay(file.files[0], seen()).then(work, work);
    file.value = "";
  });
  find("no-picture").addEventListener("click", () => {
    URL.revokeObjectURL(picture?.url);
    picture = null;
    show();
    work();
  });
}

/** Place a picture in the middle of the field; throws for a file that the browser cannot show. */
async function lay(chosen, seen) {
  const url = URL.createObjectURL(chosen);
  const size = new Image();
  size.src = url;
  try {
    await size.decode();
  } catch {
    URL.revokeObjectURL(url);
    throw new Error(say("studio.no_image", { name: chosen.name }));
  }
  if (picture) URL.revokeObjectURL(picture.url);
  const scale = PART * Math.min(seen.width / size.naturalWidth, seen.height / size.naturalHeight);
  const [width, height] = [size.naturalWidth * scale, size.naturalHeight * scale];
  const image = document.createElementNS(SVG, "image");
  image.setAttribute("class", "picture");
  image.setAttribute("href", url);
  const [x, y] = [seen.x + (seen.width - width) / 2, -(seen.y + (seen.height - height) / 2)];
  picture = { image, url, x, y, width, height };
  show();
}

/** Move the picture by a displacement. */
export function shift([dx, dy]) {
  picture.x += dx;
  picture.y += dy;
  show();
}

/** Scale the picture so that two of its places are `length` apart; the first stays fixed. */
export function scale(from, to, length) {
  const factor = length / Math.hypot(to[0] - from[0], to[1] - from[1]);
  picture.x = from[0] + (picture.x - from[0]) * factor;
  picture.y = from[1] + (picture.y - from[1]) * factor;
  picture.width *= factor;
  picture.height *= factor;
  show();
}

function show() {
  find("picture-tools").hidden = !picture;
  if (!picture) return;
  const { image, x, y, width, height } = picture;
  for (const [key, value] of Object.entries({ x, y: -y, width, height }))
    image.setAttribute(key, value);
}
