// Small pieces of the page's HTML.

type Attributes = Record<string, string | number | boolean>;

export function element<Tag extends keyof HTMLElementTagNameMap>(
    tag: Tag,
    attributes: Attributes = {},
    ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes))
        if (value === true) made.setAttribute(name, "");
        else if (value !== false) made.setAttribute(name, String(value));
    made.append(...children);
    return made;
}

export function byId(id: string): HTMLElement {
    const found = document.getElementById(id);
    if (!found) throw new Error(`index.html lacks #${id}`);
    return found;
}

/** A range with its label; `said` is what a screen reader calls a value. */
export function slider(
    label: string,
    range: { min: number; max: number; step: number },
    said: (value: number) => string,
    onInput: (value: number) => void,
): { input: HTMLInputElement; set: (value: number) => void } {
    const input = element("input", { type: "range", "aria-label": label, title: label, ...range });
    const say = () => input.setAttribute("aria-valuetext", said(input.valueAsNumber));
    input.addEventListener("input", () => {
        say();
        onInput(input.valueAsNumber);
    });
    return {
        input,
        set: (value) => {
            input.valueAsNumber = value;
            say();
        },
    };
}
