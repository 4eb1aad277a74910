/** Formats a count with thousands separators. */
export const many = (count) => count.toLocaleString("en");

/** Creates an element with properties and children. */
export function element(name, properties = {}, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
}

/** Escapes text for HTML. */
export function escaped(text) {
    return element("span", { textContent: `${text}` }).innerHTML;
}
