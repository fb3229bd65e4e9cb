; is the cover on?
        TRANS   T [20 28 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        MOVE    T
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 0,6
        SKIPN   23
        WAIT    "the cover is missing"
        CHANGE  Z 0.5
        PARK
