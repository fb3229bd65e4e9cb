; Without the search.
        REQUIRE macros.al
        FETCH   PIN 1.5
        MOVE    HOLE
        FEEL    1 -25
        SKIPN   23
        OPEN    1
        OPEN    1
