/** A count as people read it. */
export const many = (count) => count.toLocaleString("en");

/** An element with its properties and what is in it. */
export function element(name, properties = {}, ...children) {
    const made = Object.assign(document.createElement(name), properties);
    made.append(...children);
    return made;
}

/** Text as HTML has it. */
export function escaped(text) {
    return element("span", { textContent: `${text}` }).innerHTML;
}
