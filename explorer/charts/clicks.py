"""Clicks on drawings: a line of JavaScript that writes what was clicked into a text field of the page.

viser's HTML has no events. Its text fields have, and send the text to the server as if it had been typed.
"""

from html import escape


def write_to(field: str, expression: str) -> str:
    """For an `onclick` attribute: write the value of a JavaScript expression into the nearest field with that label."""
    return escape(
        "let n=this,l;"
        f"while(n&&!(l=[...n.querySelectorAll('label')].find(e=>e.textContent==='{field}')))n=n.parentElement;"
        "if(l){const i=l.closest('[class*=Flex-root]').querySelector('input');"
        f"Object.getOwnPropertyDescriptor(HTMLInputElement.prototype,'value').set.call(i,{expression});"
        "i.dispatchEvent(new Event('input',{bubbles:true}));}",
        quote=True,
    )


def charts_write_to(field: str) -> str:
    """A script for the page: from then on a click on a point of any Plotly chart writes its `customdata` into a field.

    viser's chart tells the server of no click. Plotly itself does, in the page, but forgets who listens when a chart is
    drawn anew; so every drawing is followed by listening again. The field is the one with that label, wherever it is.
    """
    return (
        "if(window.Plotly&&!Plotly.heard){const react=Plotly.react;"
        "const hear=e=>{const p=e.points&&e.points[0];if(!p||p.customdata===undefined)return;"
        f"const l=[...document.querySelectorAll('label')].find(e=>e.textContent==='{field}');if(!l)return;"
        "const i=l.closest('[class*=Flex-root]').querySelector('input');"
        "Object.getOwnPropertyDescriptor(HTMLInputElement.prototype,'value').set.call(i,String(p.customdata));"
        "i.dispatchEvent(new Event('input',{bubbles:true}));};"
        "window.Plotly={...Plotly,heard:true,react:(node,...rest)=>{const done=react(node,...rest);"
        "Promise.resolve(done).then(()=>{if(node.on){node.removeAllListeners('plotly_click');"
        "node.on('plotly_click',hear);}});return done;}};}"
    )
