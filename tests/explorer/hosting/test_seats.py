"""Places and the queue for them."""

from explorer.hosting.seats import SeatQueue


class TestSeatQueue:
    def test_places_are_given_in_order_of_arrival(self):
        seats: SeatQueue[str] = SeatQueue(2)
        assert [seats.arrive(name) for name in "abcd"] == [True, True, False, False]
        assert seats.waiting == ("c", "d")
        assert seats.leave("a") == ["c"]
        assert seats.leave("d") == []
        assert seats.leave("b") == []
        assert seats.arrive("e")

    def test_a_new_visitor_waits_behind_the_others(self):
        seats: SeatQueue[str] = SeatQueue(1)
        assert seats.arrive("a")
        assert not seats.arrive("b")
        assert seats.leave("a") == ["b"]
        assert not seats.arrive("c")

    def test_a_sleeping_page_holds_no_place_and_gets_one_back(self):
        seats: SeatQueue[str] = SeatQueue(1)
        seats.arrive("a")
        seats.arrive("b")
        assert seats.sleep("a") == ["b"]
        seats.wake("a")  # Beyond the number of places: it had one.
        assert not seats.arrive("c")
        assert seats.leave("a") == []
        assert seats.leave("b") == ["c"]

    def test_leaving_twice_frees_one_place(self):
        seats: SeatQueue[str] = SeatQueue(1)
        seats.arrive("a")
        seats.leave("a")
        seats.leave("a")
        assert seats.arrive("b")
        assert not seats.arrive("c")
