"""Whose job is next. Pages take turns: who has less under way comes first, whatever is urgent comes first among equals,
and while there are several pages none has all processes, so that whoever comes finds one free, or free soon. Pure.
"""

from explorer.workers.job import Job

MOST_WAITING = 6
"""Jobs of one page in the queue; its tabs start three."""


class Queue:
    """Jobs that wait, and which are under way."""

    def __init__(self, processes: int) -> None:
        self._processes = processes
        self._waiting: list[Job] = []
        self._running: list[Job] = []
        self._served: dict[object, int] = {}
        """When a page that still waits was last served, counted in jobs."""
        self._count = 0
        self.pages = 0
        """How many there are."""

    def __len__(self) -> int:
        return len(self._waiting)

    def __contains__(self, job: Job) -> bool:
        return job in self._waiting

    def stays(self, free: int) -> tuple[Job, ...]:
        """Those that wait on when so many processes are free, in the order in which they will come."""
        going = [job for job in self._waiting if self._may(job)][:free]
        return tuple(job for job in self._waiting if job not in going)

    def full(self, owner: object) -> bool:
        """Whether a page has so much waiting that it may add no more."""
        return owner is not None and sum(job.owner == owner for job in self._waiting) >= MOST_WAITING

    def add(self, job: Job) -> None:
        self._waiting.append(job)
        self._order()

    def remove(self, job: Job) -> None:
        """It is no longer wanted."""
        self._waiting.remove(job)
        self._order()

    def take(self) -> Job | None:
        """The job that is due, now under way; None where none is, or none may be."""
        for job in self._waiting:
            if self._may(job):
                self._waiting.remove(job)
                self._running.append(job)
                self._count += 1
                self._served[job.owner] = self._count
                self._order()
                return job
        return None

    def done(self, job: Job) -> None:
        """It is no longer under way."""
        self._running.remove(job)
        self._order()

    def clear(self) -> tuple[Job, ...]:
        """Nothing waits any more; what did."""
        waiting, self._waiting = tuple(self._waiting), []
        return waiting

    def _may(self, job: Job) -> bool:
        """Whether its page may have another process."""
        most = max(self._processes - 1, 1) if self.pages > 1 else self._processes
        return job.owner is None or self._under_way(job.owner) < most

    def _under_way(self, owner: object) -> int:
        return 0 if owner is None else sum(job.owner == owner for job in self._running)

    def _order(self) -> None:
        """A page's second job stands behind the first ones of all others, the page served last behind the others."""
        self._waiting.sort(key=lambda job: (job.urgency, job.number))
        before = {job.owner: self._under_way(job.owner) for job in self._waiting}
        rank: dict[int, int] = {}
        for job in self._waiting:
            rank[job.number] = before[job.owner]
            before[job.owner] += job.owner is not None
        known = {job.owner for job in (*self._waiting, *self._running) if job.owner is not None}
        self._served = {page: when for page, when in self._served.items() if page in known}
        self._waiting.sort(key=lambda job: (rank[job.number], self._served.get(job.owner, 0), job.urgency, job.number))
