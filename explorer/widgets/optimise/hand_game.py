"""Beat the search by hand: one session's part in a game."""

from explorer.hosting import browser
from explorer.model.inputs import inputs_of, with_optimum
from explorer.model.session_state import SessionState
from explorer.sharing.game import Game, Standing, game_from, same_but_twist
from explorer.sharing.share import DESIGN, Address, code_of, with_parameter
from explorer.text.readout import total_words
from explorer.widgets.context import TabContext
from explorer.workers.solver import BaselineCache
from rotor import Design, Solution

GAME = "game"
"""Its name in the address."""


class HandGame:
    """The designs are kept, never their powers: whoever opens the link computes them again."""

    def __init__(self, context: TabContext, address: Address) -> None:
        self._context, self._address = context, address
        self._solved = [BaselineCache(by=context.analyses.solve) for _ in range(3)]
        self.game = address.read(GAME, game_from, None, "Link: game not used")
        self.standing: Standing | None = None
        """None where there is no game, or no try at it."""
        self._best: Solution | None = None
        context.bridge.on("game_link", lambda _: self._send())
        context.bridge.on("game_take", lambda _: self._take())
        context.bridge.on("game_end", lambda _: self.begin(None))

    @property
    def solutions(self) -> tuple[Solution, ...]:
        """What the game is measured by."""
        one = self.standing
        return (
            ()
            if one is None
            else tuple(each for each in (one.least, one.start, one.to_beat) if each)
        )

    def begin(self, game: Game | None) -> None:
        """Play this from its start; None: end."""
        self.game, self.standing, self._best = game, None, None
        try:
            self._address[GAME] = None if game is None else game.code()
        except ValueError:
            self._address[GAME] = None  # No address holds a rotor of one's own.
        if game is not None:
            self._set(game.start)
        self._context.wake()

    def show(self, state: SessionState) -> None:
        """Follow a converged state. A search's preview is no try."""
        self.standing, game = None, self.game
        tried = state.solution
        if game is None or tried.design != state.inputs.design() or not game.holds(state.inputs):
            return
        designs = (game.least, game.start, game.score or game.start)
        least, start, to_beat = (
            by.solve(one) for by, one in zip(self._solved, designs, strict=True)
        )
        if not (least.converged and start.converged and to_beat.converged):
            return
        self._best = self._best or start
        # The start solved again may differ by rounding, and is no try.
        if tried.design != start.design and tried.power.total < self._best.power.total:
            self._best = tried
        self.standing = Standing(game, least, start, to_beat if game.score else None, self._best)

    def _send(self) -> None:
        """Copy a link to the same game with what was reached as the score to beat."""
        if self.standing is None:
            return
        game, best = self.standing.game, self.standing.best
        try:
            code = Game(game.start, game.least, best.design).code()
            query = with_parameter(with_parameter("", DESIGN, code_of(game.start)), GAME, code)
        except ValueError as error:
            self._context.notify("No link", str(error))
            return
        browser.copy_link(self._context.client, query)
        reached = total_words(best.power.total, self._context.units)
        self._context.notify("Link copied", f"It opens this game with {reached} to beat.")

    def _take(self) -> None:
        """The search's twist onto the sliders: the game is over."""
        if self.game is not None:
            least = self.game.least
            self.begin(None)
            self._set(least)

    def _set(self, design: Design) -> None:
        """The design onto the sliders; in the flight that they have, its twist alone."""
        now = self._context.inputs()
        try:
            same = same_but_twist(design, now.design())
        except ValueError:  # The sliders mean no design.
            same = False
        self._context.set_inputs(with_optimum(now, design) if same else inputs_of(design))
