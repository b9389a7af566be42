type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | null | undefined | EventListener>;

/** An element: attributes (functions are listeners, false and null leave out) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.replace(/^on/, ''), value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** A line icon, 20 by 20. */
export function icon(path: string): SVGSVGElement {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 20 20');
  svg.setAttribute('aria-hidden', 'true');
  svg.classList.add('icon');
  const line = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  line.setAttribute('d', path);
  svg.append(line);
  return svg;
}

export const kIcons = {
  undo: 'M7 4 3 8l4 4M3 8h9a5 5 0 0 1 0 10H8',
  redo: 'm13 4 4 4-4 4M17 8H8a5 5 0 0 0 0 10h4',
  compare: 'M10 3v14M3 4.5h14v11H3zM5.3 12.5c.8-3 1.6-3 2.4-2M12.3 12.5c.8-4 1.6-4 2.4-5',
  folder: 'M2.5 5.5a1 1 0 0 1 1-1h4l2 2h7a1 1 0 0 1 1 1v8a1 1 0 0 1-1 1h-13a1 1 0 0 1-1-1z',
  save: 'M10 3v9m0 0 3.5-3.5M10 12 6.5 8.5M3.5 13v3a1 1 0 0 0 1 1h11a1 1 0 0 0 1-1v-3',
  help: 'M10 17.5a7.5 7.5 0 1 0 0-15 7.5 7.5 0 0 0 0 15zM7.9 7.8a2.2 2.2 0 1 1 3.3 2c-.8.5-1.2.9-1.2 1.7M10 14v.2',
  mirror: 'M10 2.5v15M7.5 5 2.5 15h5zM12.5 5l5 10h-5z',
  light: 'M10 13.5a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7zM10 2v2M10 16v2M2 10h2M16 10h2M4.3 4.3l1.4 1.4M14.3 14.3l1.4 1.4M4.3 15.7l1.4-1.4M14.3 5.7l1.4-1.4',
  headset: 'M3 7.5a2 2 0 0 1 2-2h10a2 2 0 0 1 2 2v5a2 2 0 0 1-2 2h-2.3a1 1 0 0 1-.8-.4L10.7 12a1 1 0 0 0-1.4 0l-1.2 2.1a1 1 0 0 1-.8.4H5a2 2 0 0 1-2-2z',
  menu: 'M4 5.5h12M4 10h12M4 14.5h12',
  close: 'm5 5 10 10M15 5 5 15',
  chevron: 'm6 8 4 4 4-4',
  frame: 'M3 7V4a1 1 0 0 1 1-1h3M13 3h3a1 1 0 0 1 1 1v3M17 13v3a1 1 0 0 1-1 1h-3M7 17H4a1 1 0 0 1-1-1v-3',
  plus: 'M10 4v12M4 10h12',
  rename: 'M12.5 4.5l3 3L7 16l-3.5.5L4 13z',
  drawings: 'M5 6.5h11v10H5zM3.5 13.5v-10H13M8 13c1.2-3.2 2-3.5 2.8-2s1.2 1 2.4-2',
  turn: 'M4 10a6 6 0 0 1 10.5-4L17 8.5M17 4v4.5h-4.5M4 13.5h9v4H4z',
  trash: 'M4 5.5h12M8 5.5V3.8a.8.8 0 0 1 .8-.8h2.4a.8.8 0 0 1 .8.8v1.7M5.5 5.5l.7 10.5a1 1 0 0 0 1 1h5.6a1 1 0 0 0 1-1l.7-10.5',
} as const;
