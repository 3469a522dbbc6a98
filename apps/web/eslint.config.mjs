// What tsc does not see. Run from apps/web, with this file beside node_modules, where build.sh puts it.

import eslint from "@eslint/js";
import typescript from "typescript-eslint";

const here = (names) => Object.fromEntries(names.split(" ").map((name) => [name, "readonly"]));

export default [
    eslint.configs.recommended,
    ...typescript.configs.recommended,
    {
        rules: {
            eqeqeq: ["error", "always", { null: "ignore" }],
            "no-var": "error",
            "prefer-const": "error",
            "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
        },
    },
    // What is known to be there in a test, such as a number of a list.
    { files: ["test/*.ts"], rules: { "@typescript-eslint/no-non-null-assertion": "off" } },
    {
        // Part of these run in node, part in the page.
        files: ["test/*.mjs", "relamp-room.js"],
        languageOptions: {
            globals: here(
                "process URL Buffer window document location performance requestAnimationFrame " +
                    "createImageBitmap Blob File atob customElements HTMLElement Event KeyboardEvent WheelEvent " +
                    "DataTransfer TextEncoder crypto setTimeout",
            ),
        },
    },
];
