// Sets the equations of the book: blocks of the language `math`, and code between two dollars.
(function () {
    "use strict";

    function set(code, place, displayMode) {
        const math = document.createElement(displayMode ? "div" : "span");
        temml.render(code.textContent, math, { displayMode });
        place.replaceWith(math);
    }

    for (const code of document.querySelectorAll("pre > code.language-math")) {
        set(code, code.parentElement, true);
    }
    for (const code of document.querySelectorAll("code")) {
        const [before, after] = [code.previousSibling, code.nextSibling];
        if (before?.nodeType !== Node.TEXT_NODE || after?.nodeType !== Node.TEXT_NODE) continue;
        if (!before.data.endsWith("$") || !after.data.startsWith("$")) continue;
        before.data = before.data.slice(0, -1);
        after.data = after.data.slice(1);
        set(code, code, false);
    }
})();
