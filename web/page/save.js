// Saves what the page has made.

/** The name of the model's file without its ending. */
export const stem = (view) => view.facts.path.split('/').at(-1).replace(/\.[^.]+$/, '');

export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
