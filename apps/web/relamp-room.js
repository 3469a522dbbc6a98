// <relamp-room src="page"> on any page: the room of the folder `page`, without its panel. What follows # in `src` is kept.
customElements.define(
    "relamp-room",
    class extends HTMLElement {
        connectedCallback() {
            const [folder, hash = ""] = (this.getAttribute("src") ?? ".").split("#");
            const frame = document.createElement("iframe");
            frame.src = `${folder.replace(/\/(index\.html)?$/, "")}/index.html#${hash || "panel=off"}`;
            frame.title = this.getAttribute("title") ?? "A room whose lamps can be switched";
            frame.style.cssText = "width: 100%; height: 100%; border: 0";
            if (!this.style.display) this.style.display = "block";
            if (!this.style.height && this.clientHeight === 0) this.style.aspectRatio = "16 / 9";
            this.replaceChildren(frame);
        }
    },
);
