; lift a pin a little, see that it is held, and put it back
        OPEN    1
        MOVE    P2
        CLOSE   0.1
        CHANGE  [0 0 1] 0,8
        CLOSE   0.1
        SKIPN   2
        WAIT    "the pin was lost"
        MOVE    P2UP
        STOP    [0 0 -20]
        CHANGE  [0 0 -1] 1.2
        OPEN    1
        PARK
