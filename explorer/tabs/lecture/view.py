"""The caption of a lecture step, as HTML."""

from html import escape

from explorer.tabs.lecture.steps import STEPS, LectureStep

_DIFFERENCE = "The disk begins with B − A: blue is less, rust is more."


def caption(step: LectureStep, said: str) -> str:
    """Where the lecture stands, what to watch, what is seen now, what to try."""
    place = STEPS.index(step) + 1
    watch = f"{step.watch} {_DIFFERENCE}" if step.difference else step.watch
    dots = "".join(f'<i class="{"rx-here" if k + 1 == place else ""}"></i>' for k in range(len(STEPS)))
    return (
        f'<div class="rx rx-lecture" data-explorer="lecture" data-step="{place}">'
        f'<div class="rx-line"><h3>{escape(step.title)}</h3><span class="rx-dots">{dots}</span></div>'
        f"<p>{escape(watch)}</p>"
        f'<p class="rx-said" data-explorer="said">{escape(said) or "&nbsp;"}</p>'
        f'<p class="rx-dim">{escape(step.do)}</p></div>'
    )
