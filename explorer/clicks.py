"""Clicks on drawings: a line of JavaScript that writes what was clicked into a text field of the page.

viser's HTML has no events of its own; its text fields do, and tell the server as if the text had been typed.
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
