// Draws the figures into the page's elements <div class="plot" data-figure="ID">.
import { view } from './draw.ts';
import type { Data } from './data.ts';
import { figures } from './figures.ts';

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

async function draw(data: Data): Promise<void> {
  for (const figure of figures(data)) {
    const place = document.querySelector<HTMLElement>(`[data-figure="${figure.id}"]`);
    if (place === null) continue;
    const plot = view(figure);
    await plot.renderer('svg').initialize(place).hover().runAsync();
    const saves = document.createElement('p');
    saves.className = 'save';
    saves.append(
      saveLink('SVG', `${figure.id}.svg`, () => plot.toImageURL('svg')), ' ',
      saveLink('PNG', `${figure.id}.png`, () => plot.toImageURL('png', 2)));
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
