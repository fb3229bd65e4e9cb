; feel where the block stands, come back to it
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1.5
        MOVE    P
        CENTER  .2
        SAVE    D
        OPEN    1.5
        CHANGE  Z 3
        RESTORE D               ;where it really was
        MOVE    P
        CLOSE   .2
        MOVE    T
        OPEN    1.5
