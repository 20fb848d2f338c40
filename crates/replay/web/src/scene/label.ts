// Text in the scene that keeps its size on the screen.

import { CanvasTexture, Sprite, SpriteMaterial } from "three";

export function label(text: string, colour: string, height = 0.021): Sprite {
  const canvas = document.createElement("canvas");
  const font = "600 44px system-ui, sans-serif";
  const measure = canvas.getContext("2d");
  if (measure) measure.font = font;
  canvas.width = Math.ceil((measure?.measureText(text).width ?? 40) + 12);
  canvas.height = 56;
  const draw = canvas.getContext("2d");
  if (draw) {
    draw.font = font;
    draw.fillStyle = colour;
    draw.textAlign = "center";
    draw.textBaseline = "middle";
    draw.fillText(text, canvas.width / 2, canvas.height / 2 + 2);
  }
  const map = new CanvasTexture(canvas);
  map.colorSpace = "srgb";
  const material = new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false });
  const sprite = new Sprite(material);
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  sprite.renderOrder = 10;
  return sprite;
}
