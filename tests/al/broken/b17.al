; go sideways until a finger feels the rod, and take it
        TRANS   ROD [24 32 7 90 90 0]
        TRANS   PARK [20 28 8 90 90 0]
        OPEN    2
        MOVE    ROD
        TOUCH   3
        CHANGE  Y .8
        SKIPN   23
        WAIT    "no finger felt the rod"
        CENTER  .2
        CHANGE  Z 1
        PARK
