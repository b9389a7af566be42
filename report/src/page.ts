// Draws the figures into the page's elements <div class="plot" data-figure="ID">.
import { svgOf, view } from './draw.ts';
import type { Data } from './data.ts';
import { figures } from './figures.ts';
import { typesetText } from './typeset.ts';

function saveLink(label: string, name: string, make: () => Promise<string>): HTMLAnchorElement {
  const link = document.createElement('a');
  link.textContent = label;
  link.href = '#';
  link.addEventListener('click', async (event) => {
    event.preventDefault();
    const file = document.createElement('a');
    file.href = await make();
    file.download = name;
    file.click();
  });
  return link;
}

// Twice as fine as the screen.
async function pngOf(svg: string): Promise<string> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = 2 * image.width;
  canvas.height = 2 * image.height;
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  return canvas.toDataURL('image/png');
}

async function draw(data: Data): Promise<void> {
  for (const figure of figures(data)) {
    const place = document.querySelector<HTMLElement>(`[data-figure="${figure.id}"]`);
    if (place === null) continue;
    const plot = view(figure);
    await plot.renderer('svg').initialize(place).hover().runAsync();
    for (const text of place.querySelectorAll('text'))
      text.innerHTML = typesetText(text.innerHTML, Number.parseFloat(text.getAttribute('font-size') ?? '11'));
    const saves = document.createElement('p');
    saves.className = 'save';
    saves.append(
      saveLink('SVG', `${figure.id}.svg`, async () => URL.createObjectURL(new Blob([await svgOf(plot)], { type: 'image/svg+xml' }))), ' ',
      saveLink('PNG', `${figure.id}.png`, async () => pngOf(await svgOf(plot))));
    place.after(saves);
  }
}

const source = document.getElementById('data')!.textContent!;
draw(JSON.parse(source) as Data).then(
  () => { document.body.dataset.drawn = 'yes'; },
  (error: unknown) => {
    document.body.dataset.drawn = 'no';
    throw error;
  });
